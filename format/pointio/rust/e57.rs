// SPDX-License-Identifier: Apache-2.0
//! E57 files (ASTM E2807): the crate reads the header and the XML section, e57_points.rs the points.
use std::ffi::{c_char, c_void, CString};
use std::io::Cursor;
use std::slice;

use ::e57::{ColorLimits, E57Reader, Error, PointCloud, Record, RecordDataType, RecordName, RecordValue};

use crate::e57_pages::Pages;
use crate::e57_points::{bits_of, Points};
use crate::e57_xml;
use crate::guard::{guarded, ScanError};


/// scan_e57_column of rust_abi.h.
#[repr(C)]
pub struct Column {
    name: *const c_char,
    kind: u32,
    least: i64,
    most: i64,
    scale: f64,
    offset: f64,
}

/// scan_e57_limits of rust_abi.h.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Limits {
    are_there: bool,
    least: f64,
    most: f64,
}

/// scan_e57_scan of rust_abi.h.
#[repr(C)]
pub struct ScanFacts {
    name: *const c_char,
    guid: *const c_char,
    points: u64,
    columns: *const Column,
    column_count: usize,
    has_pose: bool,
    rotation: [f64; 4],
    translation: [f64; 3],
    color_limits: [Limits; 3],
    intensity_limits: Limits,
}

/// Owns what a scan_e57_scan points to. Both are on the heap, so their addresses are stable while the file is open.
struct Scan {
    cloud: PointCloud,
    name: CString,
    guid: CString,
    columns: Vec<Column>,
    column_names: Vec<CString>,
}

/// scan_e57 of rust_abi.h.
pub struct E57File<'a> {
    bytes: &'a [u8],
    scans: Vec<Scan>,
    images: usize,
    coordinate_metadata: CString,
}

/// "reason: cause", without the crate's preamble.
fn reason(error: Error) -> String {
    let (text, source) = match error {
        Error::Invalid { desc, source } | Error::Read { desc, source } | Error::Internal { desc, source } => {
            (desc, source)
        }
        other => (other.to_string(), None),
    };
    match source {
        Some(source) => format!("{text}: {source}"),
        None => text,
    }
}

fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// "colorRed", or "nor:normalX" of an extension.
fn name_of(record: &Record) -> &'static str {
    match record.name {
        RecordName::CartesianX => "cartesianX",
        RecordName::CartesianY => "cartesianY",
        RecordName::CartesianZ => "cartesianZ",
        RecordName::CartesianInvalidState => "cartesianInvalidState",
        RecordName::SphericalRange => "sphericalRange",
        RecordName::SphericalAzimuth => "sphericalAzimuth",
        RecordName::SphericalElevation => "sphericalElevation",
        RecordName::SphericalInvalidState => "sphericalInvalidState",
        RecordName::Intensity => "intensity",
        RecordName::IsIntensityInvalid => "isIntensityInvalid",
        RecordName::ColorRed => "colorRed",
        RecordName::ColorGreen => "colorGreen",
        RecordName::ColorBlue => "colorBlue",
        RecordName::IsColorInvalid => "isColorInvalid",
        RecordName::RowIndex => "rowIndex",
        RecordName::ColumnIndex => "columnIndex",
        RecordName::ReturnCount => "returnCount",
        RecordName::ReturnIndex => "returnIndex",
        RecordName::TimeStamp => "timeStamp",
        RecordName::IsTimeStampInvalid => "isTimeStampInvalid",
        RecordName::Unknown { .. } => "",
    }
}

fn full_name_of(record: &Record) -> CString {
    match &record.name {
        RecordName::Unknown { namespace, name } if !namespace.is_empty() => c_text(&format!("{namespace}:{name}")),
        RecordName::Unknown { name, .. } => c_text(name),
        _ => c_text(name_of(record)),
    }
}

const NO_LIMITS: Limits = Limits { are_there: false, least: 0.0, most: 0.0 };

/// Integers without limits in their type have the range of 64 bits.
fn limits_of_type(data_type: &RecordDataType) -> Option<(f64, f64)> {
    match *data_type {
        RecordDataType::Integer { min: i64::MIN, max: i64::MAX } => None,
        RecordDataType::ScaledInteger { min: i64::MIN, max: i64::MAX, .. } => None,
        RecordDataType::Integer { min, max } => Some((min as f64, max as f64)),
        RecordDataType::ScaledInteger { min, max, scale, offset } => {
            Some((min as f64 * scale + offset, max as f64 * scale + offset))
        }
        RecordDataType::Single { min, max } => Some((min?.into(), max?.into())),
        RecordDataType::Double { min, max } => Some((min?, max?)),
    }
}

/// In the order of SCAN_E57_*.
fn column_of(record: &Record, name: &CString) -> Column {
    let (kind, least, most, scale, offset) = match record.data_type {
        RecordDataType::Integer { min, max } => (0, min, max, 1.0, 0.0),
        RecordDataType::ScaledInteger { min, max, scale, offset } => (1, min, max, scale, offset),
        RecordDataType::Single { .. } => (2, 0, 0, 1.0, 0.0),
        RecordDataType::Double { .. } => (3, 0, 0, 1.0, 0.0),
    };
    Column { name: name.as_ptr(), kind, least, most, scale, offset }
}

impl Scan {
    fn of(cloud: PointCloud) -> Self {
        let column_names: Vec<CString> = cloud.prototype.iter().map(full_name_of).collect();
        let columns = cloud.prototype.iter().zip(&column_names).map(|(record, name)| column_of(record, name)).collect();
        let text = |text: &Option<String>| c_text(text.as_deref().unwrap_or_default());
        let (name, guid) = (text(&cloud.name), text(&cloud.guid));
        Self { cloud, name, guid, columns, column_names }
    }

    /// The limits of a column, from the scan or else from the column's type, scaled like the column.
    fn limits(&self, column: RecordName, least: &Option<RecordValue>, most: &Option<RecordValue>) -> Limits {
        let record = self.cloud.prototype.iter().find(|record| record.name == column);
        let given = |value: &Option<RecordValue>| value.as_ref()?.to_f64(&record?.data_type).ok();
        given(least).zip(given(most)).or_else(|| limits_of_type(&record?.data_type)).map_or(
            NO_LIMITS,
            |(least, most)| Limits { are_there: true, least, most },
        )
    }

    fn color_limits(&self) -> [Limits; 3] {
        let none = ColorLimits {
            red_min: None,
            red_max: None,
            green_min: None,
            green_max: None,
            blue_min: None,
            blue_max: None,
        };
        let all = self.cloud.color_limits.as_ref().unwrap_or(&none);
        [
            self.limits(RecordName::ColorRed, &all.red_min, &all.red_max),
            self.limits(RecordName::ColorGreen, &all.green_min, &all.green_max),
            self.limits(RecordName::ColorBlue, &all.blue_min, &all.blue_max),
        ]
    }

    fn intensity_limits(&self) -> Limits {
        let limits = self.cloud.intensity_limits.as_ref();
        let (least, most) = limits.map_or((&None, &None), |limits| (&limits.intensity_min, &limits.intensity_max));
        self.limits(RecordName::Intensity, least, most)
    }

    fn facts(&self) -> ScanFacts {
        let pose = self.cloud.transform.clone().unwrap_or_default();
        let (turn, shift) = (pose.rotation, pose.translation);
        ScanFacts {
            name: self.name.as_ptr(),
            guid: self.guid.as_ptr(),
            points: self.cloud.records,
            columns: self.columns.as_ptr(),
            column_count: self.columns.len(),
            has_pose: self.cloud.transform.is_some(),
            rotation: [turn.w, turn.x, turn.y, turn.z],
            translation: [shift.x, shift.y, shift.z],
            color_limits: self.color_limits(),
            intensity_limits: self.intensity_limits(),
        }
    }
}

fn u64_at(bytes: &[u8], at: usize) -> Result<u64, String> {
    let field = bytes.get(at..at + 8).ok_or("is cut short")?;
    Ok(u64::from_le_bytes(field.try_into().unwrap()))
}

/// Reads the XML section before the crate does, which allocates as much as the header states and reports a wrong
/// checksum as a truncated file.
fn xml_of(bytes: &[u8]) -> Result<Vec<u8>, String> {
    const OFFSET_AT: usize = 24;
    const LENGTH_AT: usize = 32;
    const OUTSIDE: &str = "is broken or cut short: its XML section lies outside the file";
    let mut pages = Pages::of(bytes);
    let start = pages.logical(u64_at(bytes, OFFSET_AT)?).ok_or(OUTSIDE)?;
    let length = u64_at(bytes, LENGTH_AT)?;
    if length > pages.len() - start {
        return Err(OUTSIDE.to_string());
    }
    let mut xml = Vec::new();
    pages.read(start, length as usize, &mut xml)?;
    Ok(xml)
}

/// Readers allocate for as many points as a file states, and scans may share their bytes or have none.
fn check_points(clouds: &[PointCloud], file_bytes: usize) -> Result<(), String> {
    let bits: u128 = clouds.iter().map(bits_of).sum();
    if bits > 8 * file_bytes as u128 {
        let points: u128 = clouds.iter().map(|cloud| u128::from(cloud.records)).sum();
        return Err(format!("promises {points} points in {file_bytes} bytes"));
    }
    Ok(())
}

fn open(bytes: &[u8]) -> Result<E57File<'_>, String> {
    e57_xml::check(&xml_of(bytes)?)?;
    let reader = E57Reader::new(Cursor::new(bytes)).map_err(reason)?;
    check_points(&reader.pointclouds(), bytes.len())?;
    Ok(E57File {
        bytes,
        scans: reader.pointclouds().into_iter().map(Scan::of).collect(),
        images: reader.images().len(),
        coordinate_metadata: c_text(reader.coordinate_metadata().unwrap_or_default()),
    })
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_e57_open<'a>(
    bytes: *const u8,
    size: usize,
    error: &mut ScanError,
) -> Option<Box<E57File<'a>>> {
    let bytes: &[u8] = if size == 0 { &[] } else { slice::from_raw_parts(bytes, size) };
    guarded(error, || open(bytes)).map(Box::new)
}

#[no_mangle]
pub extern "C" fn scan_e57_close(file: Option<Box<E57File<'_>>>) {
    drop(file);
}

#[no_mangle]
pub extern "C" fn scan_e57_scans(file: &E57File<'_>) -> usize {
    file.scans.len()
}

#[no_mangle]
pub extern "C" fn scan_e57_images(file: &E57File<'_>) -> usize {
    file.images
}

#[no_mangle]
pub extern "C" fn scan_e57_coordinate_metadata(file: &E57File<'_>) -> *const c_char {
    file.coordinate_metadata.as_ptr()
}

#[no_mangle]
pub extern "C" fn scan_e57_describe(file: &E57File<'_>, scan: usize) -> ScanFacts {
    file.scans[scan].facts()
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_e57_begin<'a>(
    file: &E57File<'a>,
    scan: usize,
    error: &mut ScanError,
) -> Option<Box<Points<'a>>> {
    let scan = &file.scans[scan];
    guarded(error, || Points::of(file.bytes, &scan.cloud, &scan.column_names)).map(Box::new)
}

/// # Safety
/// As rust_abi.h says.
#[no_mangle]
pub unsafe extern "C" fn scan_e57_read(
    points: &mut Points<'_>,
    capacity: usize,
    columns: *const *mut c_void,
    count: &mut usize,
    error: &mut ScanError,
) -> bool {
    let columns: &[*mut c_void] = slice::from_raw_parts(columns, points.column_count());
    let read = guarded(error, || points.read(capacity, columns));
    *count = read.unwrap_or(0);
    read.is_some()
}

#[no_mangle]
pub extern "C" fn scan_e57_position(points: &Points<'_>) -> u64 {
    points.position()
}

#[no_mangle]
pub extern "C" fn scan_e57_end(points: Option<Box<Points<'_>>>) {
    drop(points);
}
