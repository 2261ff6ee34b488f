// SPDX-License-Identifier: Apache-2.0
//! The points of a scan: a compressed vector (ASTM E2807, 9.3), packets that hold a piece of each column's bit stream.
//! The crate's own reader puts every number on the heap, which is five to seven times slower, and unbounded if no column has
//! any bits. It also reads index packets as 16 bytes too long.
use std::ffi::{c_void, CString};

use ::e57::{PointCloud, RecordDataType};

use crate::e57_pages::Pages;

const SECTION_HEADER: usize = 32;
const COMPRESSED_VECTOR: u8 = 1;
/// Kinds of packets: 0 is an index, 2 is ignored.
const DATA_PACKET: u8 = 1;
const IGNORED_PACKET: u8 = 2;
/// Padding, so that 8 bytes can be read from any bit.
const PADDING: usize = 8;

/// The encoding of a column.
#[derive(Clone, Copy)]
enum Number {
    /// `least` and an unsigned number of up to `range`.
    Whole { least: i64, range: u64 },
    Single,
    Double,
}

/// The numbers of a column, and the bits of each.
fn number_of(data_type: &RecordDataType) -> (Number, usize) {
    match *data_type {
        RecordDataType::Single { .. } => (Number::Single, 32),
        RecordDataType::Double { .. } => (Number::Double, 64),
        RecordDataType::Integer { min, max } | RecordDataType::ScaledInteger { min, max, .. } => {
            let range = max.wrapping_sub(min) as u64;
            (Number::Whole { least: min, range }, (u64::BITS - range.leading_zeros()) as usize)
        }
    }
}

/// The bits of all points of a scan.
pub fn bits_of(cloud: &PointCloud) -> u128 {
    let each: usize = cloud.prototype.iter().map(|record| number_of(&record.data_type).1).sum();
    u128::from(cloud.records) * each.max(1) as u128
}

/// The bits of one column from consecutive packets that have not been consumed.
struct Stream {
    name: String,
    number: Number,
    width: usize, // bits each
    bytes: Vec<u8>,
    size: usize, // bytes without the padding
    at: usize,   // the next bit
}

impl Stream {
    fn of(name: &CString, data_type: &RecordDataType) -> Self {
        let (number, width) = number_of(data_type);
        let name = name.to_string_lossy().into_owned();
        Self { name, number, width, bytes: vec![0; PADDING], size: 0, at: 0 }
    }

    /// None: any number of values, for columns without bits.
    fn available(&self) -> Option<usize> {
        (self.size * 8 - self.at).checked_div(self.width)
    }

    fn append(&mut self, piece: &[u8]) {
        let taken = self.at / 8;
        self.bytes.copy_within(taken..self.size, 0);
        self.size -= taken;
        self.at -= taken * 8;
        self.bytes.truncate(self.size);
        self.bytes.extend_from_slice(piece);
        self.size = self.bytes.len();
        self.bytes.resize(self.size + PADDING, 0);
    }

    fn word(&self, byte: usize) -> u64 {
        u64::from_le_bytes(self.bytes[byte..byte + 8].try_into().unwrap())
    }

    /// Numbers of up to 57 bits fit in 8 bytes at any bit offset.
    fn take_narrow(&mut self, least: i64, values: &mut [i64]) -> u64 {
        let mask = (1u64 << self.width) - 1;
        let mut largest = 0;
        for value in values {
            let bits = (self.word(self.at / 8) >> (self.at % 8)) & mask;
            self.at += self.width;
            largest = largest.max(bits);
            *value = least.wrapping_add(bits as i64);
        }
        largest
    }

    fn take_wide(&mut self, least: i64, values: &mut [i64]) -> u64 {
        let mut largest = 0;
        for value in values {
            let (byte, shift) = (self.at / 8, self.at % 8);
            let high = self.bytes.get(byte + 8).copied().unwrap_or(0);
            let bits = (u128::from(self.word(byte)) | u128::from(high) << 64) >> shift;
            let bits = bits as u64 & (u64::MAX >> (64 - self.width));
            self.at += self.width;
            largest = largest.max(bits);
            *value = least.wrapping_add(bits as i64);
        }
        largest
    }

    fn take_whole(&mut self, least: i64, range: u64, values: &mut [i64]) -> Result<(), String> {
        let largest = match self.width {
            0 => {
                values.fill(least);
                0
            }
            1..=57 => self.take_narrow(least, values),
            _ => self.take_wide(least, values),
        };
        if largest > range {
            return Err(format!("is broken: a value of {} is above the declared maximum", self.name));
        }
        Ok(())
    }

    /// SAFETY: `into` has room for `count` numbers of the stream's kind, and the stream holds them.
    unsafe fn take(&mut self, count: usize, into: *mut c_void) -> Result<(), String> {
        if into.is_null() {
            self.at += count * self.width;
            return Ok(());
        }
        if let Number::Whole { least, range } = self.number {
            return self.take_whole(least, range, std::slice::from_raw_parts_mut(into.cast(), count));
        }
        // floats are byte-aligned and little-endian, like the machine
        let (from, size) = (self.at / 8, count * self.width / 8);
        std::ptr::copy_nonoverlapping(self.bytes[from..from + size].as_ptr(), into.cast(), size);
        self.at += count * self.width;
        Ok(())
    }
}

/// scan_e57_points of rust_abi.h: the state of reading a scan.
pub struct Points<'a> {
    pages: Pages<'a>,
    at: u64, // the next packet, logical
    end: u64,
    total: u64,
    done: u64,
    streams: Vec<Stream>,
    packet: Vec<u8>,
}

fn u16_at(bytes: &[u8], at: usize) -> usize {
    usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]))
}

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
}

impl<'a> Points<'a> {
    /// names: of the columns
    pub fn of(bytes: &'a [u8], cloud: &PointCloud, names: &[CString]) -> Result<Self, String> {
        let columns = cloud.prototype.iter().zip(names);
        let streams = columns.map(|(record, name)| Stream::of(name, &record.data_type)).collect();
        let mut points =
            Self { pages: Pages::of(bytes), at: 0, end: 0, total: cloud.records, done: 0, streams, packet: Vec::new() };
        if cloud.records > 0 {
            points.open_section(cloud.file_offset)?;
        }
        Ok(points)
    }

    pub fn column_count(&self) -> usize {
        self.streams.len()
    }

    /// Where in the file the next packet is.
    pub fn position(&self) -> u64 {
        self.pages.physical(self.at)
    }

    fn open_section(&mut self, physical: u64) -> Result<(), String> {
        const OUTSIDE: &str = "is broken or cut short: its points lie outside the file";
        let start = self.pages.logical(physical).ok_or(OUTSIDE)?;
        let mut header = Vec::new();
        self.pages.read(start, SECTION_HEADER, &mut header)?;
        if header[0] != COMPRESSED_VECTOR {
            return Err("is broken: the section of points is not where the XML says it is".to_string());
        }
        self.end = start.checked_add(u64_at(&header, 8)).ok_or(OUTSIDE)?.min(self.pages.len());
        self.at = self.pages.logical(u64_at(&header, 16)).ok_or(OUTSIDE)?;
        Ok(())
    }

    fn available(&self) -> usize {
        self.streams.iter().filter_map(Stream::available).min().unwrap_or(usize::MAX)
    }

    fn next_packet(&mut self) -> Result<(), String> {
        if self.at >= self.end {
            return Err(format!("is cut short: {} of {} points are there", self.done, self.total));
        }
        self.packet.clear();
        self.pages.read(self.at, 4, &mut self.packet)?;
        let (kind, size) = (self.packet[0], u16_at(&self.packet, 2) + 1);
        if size % 4 != 0 || kind > IGNORED_PACKET || size as u64 > self.end - self.at {
            return Err(format!("is broken: a packet is missing after {} points", self.done));
        }
        if kind == DATA_PACKET {
            self.pages.read(self.at + 4, size - 4, &mut self.packet)?;
            self.split_packet()?;
        }
        self.at += size as u64;
        Ok(())
    }

    /// Sizes of the pieces, two bytes each, and the pieces.
    fn split_packet(&mut self) -> Result<(), String> {
        let broken = || "is broken: a packet's columns do not fit in it".to_string();
        let count = self.streams.len();
        let mut at = 6 + 2 * count;
        if self.packet.len() < at || u16_at(&self.packet, 4) != count {
            return Err(broken());
        }
        for (i, stream) in self.streams.iter_mut().enumerate() {
            let size = u16_at(&self.packet, 6 + 2 * i);
            stream.append(self.packet.get(at..at + size).ok_or_else(broken)?);
            at += size;
        }
        Ok(())
    }

    /// The number of points read; 0 after the last.
    /// SAFETY: columns as for scan_e57_read.
    pub unsafe fn read(&mut self, capacity: usize, columns: &[*mut c_void]) -> Result<usize, String> {
        let left = (self.total - self.done).min(capacity as u64) as usize;
        if left == 0 {
            return Ok(0);
        }
        while self.available() == 0 {
            self.next_packet()?;
        }
        let count = self.available().min(left);
        for (stream, &into) in self.streams.iter_mut().zip(columns) {
            stream.take(count, into)?;
        }
        self.done += count as u64;
        Ok(count)
    }
}
