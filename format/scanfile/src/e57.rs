// SPDX-License-Identifier: Apache-2.0
//! E57 files.
