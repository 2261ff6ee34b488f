// SPDX-License-Identifier: Apache-2.0
//! The border to C: errors become text in the caller's buffer, and no panic crosses it.
use std::panic::{catch_unwind, set_hook, AssertUnwindSafe};
use std::sync::Once;

/// scan_error of rust_abi.h.
#[repr(C)]
pub struct ScanError {
    text: [u8; 256],
}

impl ScanError {
    /// Keeps what fits, whole characters, and ends it with a 0.
    fn set(&mut self, message: &str) {
        let mut length = message.len().min(self.text.len() - 1);
        while !message.is_char_boundary(length) {
            length -= 1;
        }
        self.text[..length].copy_from_slice(&message.as_bytes()[..length]);
        self.text[length] = 0;
    }
}

/// A panic prints nothing: guarded() tells of it.
fn silence_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| set_hook(Box::new(|_| {})));
}

/// Runs work; None, and why in error, where it fails or panics, as decoders do on broken data.
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
