// SPDX-License-Identifier: Apache-2.0
//! The C boundary: errors become text in the caller's buffer, and panics do not cross it.
use std::panic::{catch_unwind, set_hook, AssertUnwindSafe};
use std::sync::Once;

/// scan_error of rust_abi.h.
#[repr(C)]
pub struct ScanError {
    text: [u8; 256],
}

impl ScanError {
    /// Copies as many complete characters as fit, and a terminating 0.
    fn set(&mut self, message: &str) {
        let mut length = message.len().min(self.text.len() - 1);
        while !message.is_char_boundary(length) {
            length -= 1;
        }
        self.text[..length].copy_from_slice(&message.as_bytes()[..length]);
        self.text[length] = 0;
    }
}

/// Panics print nothing; guarded() reports them.
fn silence_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| set_hook(Box::new(|_| {})));
}

/// Runs work. Returns None with the reason in error if it fails or panics, as decoders do on malformed data.
pub fn guarded<T>(error: &mut ScanError, work: impl FnOnce() -> Result<T, String>) -> Option<T> {
    silence_panics();
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(value)) => Some(value),
        Ok(Err(message)) => {
            error.set(&message);
            None
        }
        Err(_) => {
            error.set("is broken");
            None
        }
    }
}
