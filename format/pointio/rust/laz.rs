// SPDX-License-Identifier: Apache-2.0
//! Compresses and decompresses the points of LAZ files chunk by chunk. Callers locate the chunks.
use std::io::{Cursor, ErrorKind};
use std::slice;

use laz::laszip::{ChunkTable, ChunkTableEntry};
use laz::record::{
    LayeredPointRecordCompressor, LayeredPointRecordDecompressor, RecordCompressor,
    RecordDecompressor, SequentialPointRecordCompressor, SequentialPointRecordDecompressor,
};
use laz::{LazItemType, LazVlr, LazVlrBuilder};

use crate::guard::{guarded, ScanError};

/// Limit of extra bytes, whose models take some 4 KiB for each byte; no scan has more.
const MOST_EXTRA_BYTES: u16 = 1024;

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}

fn reason(error: std::io::Error) -> String {
    match error.kind() {
        ErrorKind::UnexpectedEof => "is cut short".to_string(),
        _ => error.to_string(),
    }
}

/// SAFETY: points to at least `bytes` bytes that do not change while the slice is in use.
unsafe fn bytes_of<'a>(data: *const u8, bytes: usize) -> &'a [u8] {
    if bytes == 0 {
        &[]
    } else {
        slice::from_raw_parts(data, bytes)
    }
}

fn vlr_from(record: &[u8]) -> Result<LazVlr, String> {
    let vlr = LazVlr::from_buffer(record).map_err(text)?;
    let extra = |item: &LazItemType| match item {
        LazItemType::Byte(count) | LazItemType::Byte14(count) => *count,
        _ => 0,
    };
    if vlr.items().is_empty() {
        return Err("compresses nothing".to_string());
    }
    if vlr.items().iter().any(|item| extra(&item.item_type()) > MOST_EXTRA_BYTES) {
        return Err(format!("has more than {MOST_EXTRA_BYTES} extra bytes a point"));
    }
    Ok(vlr)
}

fn is_layered(vlr: &LazVlr) -> bool {
    vlr.items()[0].version() >= 3
}

/// The number of layers of an item in a chunk.
fn layers_of(item: LazItemType) -> usize {
    match item {
        LazItemType::Point14 => 9,
        LazItemType::RGBNIR14 => 2,
        LazItemType::Byte14(count) => count as usize,
        _ => 1,
    }
}

/// The decoder allocates its layers before reading them, so impossible sizes are refused first.
fn check_layers(vlr: &LazVlr, record_bytes: usize, chunk: &[u8]) -> Result<(), String> {
    let layers: usize = vlr.items().iter().map(|item| layers_of(item.item_type())).sum();
    let first = record_bytes + 4; // after the first point and the number of points
    let sizes = chunk.get(first..first + 4 * layers).ok_or("is cut short")?;
    let sum: u64 = sizes.chunks_exact(4).map(|size| u32::from_le_bytes(size.try_into().unwrap()) as u64).sum();
    if sum > (chunk.len() - first - 4 * layers) as u64 {
        return Err("is cut short".to_string());
    }
    Ok(())
}

type Decoder<'a> = dyn RecordDecompressor<Cursor<&'a [u8]>> + Send + Sync + 'a;

/// scan_laz_reader of rust_abi.h.
pub struct LazReader<'a> {
    decoder: Box<Decoder<'a>>,
}

fn open<'a>(vlr: &[u8], record_bytes: usize, chunk: &'a [u8]) -> Result<LazReader<'a>, String> {
    let vlr = vlr_from(vlr)?;
    let mut decoder: Box<Decoder<'a>> = if is_layered(&vlr) {
        Box::new(LayeredPointRecordDecompressor::new(Cursor::new(chunk)))
    } else {
        Box::new(SequentialPointRecordDecompressor::new(Cursor::new(chunk)))
    };
    decoder.set_fields_from(vlr.items()).map_err(text)?;
    if decoder.record_size() != record_bytes {
        return Err(format!("has points of {} bytes, not {record_bytes}", decoder.record_size()));
    }
    if is_layered(&vlr) {
        check_layers(&vlr, record_bytes, chunk)?;
    }
    Ok(LazReader { decoder })
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_laz_open<'a>(
    vlr: *const u8,
    vlr_bytes: usize,
    record_bytes: usize,
    chunk: *const u8,
    chunk_bytes: usize,
    error: &mut ScanError,
) -> Option<Box<LazReader<'a>>> {
    let (vlr, chunk) = (bytes_of(vlr, vlr_bytes), bytes_of(chunk, chunk_bytes));
    guarded(error, || open(vlr, record_bytes, chunk)).map(Box::new)
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_laz_read(
    reader: &mut LazReader<'_>,
    records: *mut u8,
    bytes: usize,
    error: &mut ScanError,
) -> bool {
    let records = slice::from_raw_parts_mut(records, bytes);
    guarded(error, || reader.decoder.decompress_many(records).map_err(reason)).is_some()
}

#[no_mangle]
pub extern "C" fn scan_laz_consumed(reader: &LazReader<'_>) -> u64 {
    reader.decoder.get().position()
}

#[no_mangle]
pub extern "C" fn scan_laz_close(reader: Option<Box<LazReader<'_>>>) {
    drop(reader);
}

fn read_table(table: &[u8], has_counts: bool, counts: &mut [u64], sizes: &mut [u64]) -> Result<(), String> {
    let entries = ChunkTable::read(&mut Cursor::new(table), has_counts).map_err(reason)?;
    for (i, entry) in entries.as_ref().iter().enumerate().take(sizes.len()) {
        counts[i] = entry.point_count;
        sizes[i] = entry.byte_count;
    }
    if entries.len() == sizes.len() {
        Ok(())
    } else {
        Err("is cut short".to_string())
    }
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_laz_read_table(
    table: *const u8,
    table_bytes: usize,
    has_counts: bool,
    chunks: usize,
    counts: *mut u64,
    sizes: *mut u64,
    error: &mut ScanError,
) -> bool {
    if chunks == 0 {
        return true;
    }
    let table = bytes_of(table, table_bytes);
    let counts = slice::from_raw_parts_mut(counts, chunks);
    let sizes = slice::from_raw_parts_mut(sizes, chunks);
    guarded(error, || read_table(table, has_counts, counts, sizes)).is_some()
}

/// scan_write of rust_abi.h.
type Write = extern "C" fn(user: *mut std::ffi::c_void, data: *const u8, bytes: usize) -> bool;

fn give(bytes: &[u8], write: Write, user: *mut std::ffi::c_void) -> Result<(), String> {
    if write(user, bytes.as_ptr(), bytes.len()) {
        Ok(())
    } else {
        Err("cannot be written".to_string())
    }
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_laz_describe(
    point_format: u8,
    extra_bytes: u16,
    chunk_points: u32,
    write: Write,
    user: *mut std::ffi::c_void,
    error: &mut ScanError,
) -> bool {
    guarded(error, || {
        let builder = LazVlrBuilder::default().with_point_format(point_format, extra_bytes).map_err(text)?;
        let mut record = Vec::new();
        builder.with_fixed_chunk_size(chunk_points).build().write_to(&mut record).map_err(reason)?;
        give(&record, write, user)
    })
    .is_some()
}

fn pack(vlr: &[u8], records: &[u8]) -> Result<Vec<u8>, String> {
    let vlr = vlr_from(vlr)?;
    let mut encoder: Box<dyn RecordCompressor<Cursor<Vec<u8>>>> = if is_layered(&vlr) {
        Box::new(LayeredPointRecordCompressor::new(Cursor::new(Vec::new())))
    } else {
        Box::new(SequentialPointRecordCompressor::new(Cursor::new(Vec::new())))
    };
    encoder.set_fields_from(vlr.items()).map_err(text)?;
    for record in records.chunks_exact(encoder.record_size()) {
        encoder.compress_next(record).map_err(reason)?;
    }
    encoder.done().map_err(reason)?;
    Ok(encoder.box_into_inner().into_inner())
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_laz_pack(
    vlr: *const u8,
    vlr_bytes: usize,
    records: *const u8,
    bytes: usize,
    write: Write,
    user: *mut std::ffi::c_void,
    error: &mut ScanError,
) -> bool {
    let (vlr, records) = (bytes_of(vlr, vlr_bytes), bytes_of(records, bytes));
    guarded(error, || give(&pack(vlr, records)?, write, user)).is_some()
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_laz_pack_table(
    vlr: *const u8,
    vlr_bytes: usize,
    counts: *const u64,
    sizes: *const u64,
    chunks: usize,
    write: Write,
    user: *mut std::ffi::c_void,
    error: &mut ScanError,
) -> bool {
    let vlr = bytes_of(vlr, vlr_bytes);
    let entries = (0..chunks).map(|i| ChunkTableEntry { point_count: *counts.add(i), byte_count: *sizes.add(i) });
    guarded(error, || {
        let mut table = ChunkTable::with_capacity(chunks);
        for entry in entries {
            table.push(entry);
        }
        let mut bytes = Vec::new();
        table.write_to(&mut bytes, &vlr_from(vlr)?).map_err(reason)?;
        give(&bytes, write, user)
    })
    .is_some()
}
