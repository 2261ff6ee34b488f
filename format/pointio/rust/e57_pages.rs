// SPDX-License-Identifier: Apache-2.0
//! A file without its checksums. It consists of pages of 1024 bytes, whose last 4 bytes are the big-endian CRC-32C of the
//! others. Physical offsets include checksums, logical ones do not.
const PAGE: usize = 1024;
const PAYLOAD: usize = PAGE - 4;

pub struct Pages<'a> {
    bytes: &'a [u8],
    /// The last page with a verified checksum: pages are mostly read in sequence, in several pieces.
    good: Option<usize>,
}

impl<'a> Pages<'a> {
    pub fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, good: None }
    }

    /// Logical bytes of all complete pages.
    pub fn len(&self) -> u64 {
        (self.bytes.len() / PAGE * PAYLOAD) as u64
    }

    /// The logical offset of a physical one; None within a checksum or beyond the file.
    pub fn logical(&self, physical: u64) -> Option<u64> {
        let (page, inside) = (physical / PAGE as u64, physical % PAGE as u64);
        let at = page * PAYLOAD as u64 + inside;
        (inside < PAYLOAD as u64 && at < self.len()).then_some(at)
    }

    pub fn physical(&self, logical: u64) -> u64 {
        logical / PAYLOAD as u64 * PAGE as u64 + logical % PAYLOAD as u64
    }

    fn payload(&mut self, page: usize) -> Result<&'a [u8], String> {
        let bytes = &self.bytes[page * PAGE..(page + 1) * PAGE];
        let (payload, checksum) = bytes.split_at(PAYLOAD);
        if self.good != Some(page) {
            if crc32c::crc32c(payload).to_be_bytes() != checksum {
                return Err(format!("is broken: wrong checksum of the page at byte {}", page * PAGE));
            }
            self.good = Some(page);
        }
        Ok(payload)
    }

    /// Appends `size` bytes from a logical offset on.
    pub fn read(&mut self, at: u64, size: usize, into: &mut Vec<u8>) -> Result<(), String> {
        if at.checked_add(size as u64).is_none_or(|end| end > self.len()) {
            return Err("is cut short".to_string());
        }
        let (mut at, end) = (at as usize, at as usize + size);
        while at < end {
            let (page, inside) = (at / PAYLOAD, at % PAYLOAD);
            let count = (PAYLOAD - inside).min(end - at);
            into.extend_from_slice(&self.payload(page)?[inside..inside + count]);
            at += count;
        }
        Ok(())
    }
}
