// SPDX-License-Identifier: Apache-2.0
//! The Rust half of pointrt_pointio, called through rust_abi.h.
mod e57;
mod e57_pages;
mod e57_points;
mod e57_xml;
mod guard;
mod laz;
