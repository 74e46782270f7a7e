//! Kiri as C has it: see the crate `kiri` for what is safe, and `kiri.h` for what each function does.
#![no_std]
#![allow(non_camel_case_types, non_snake_case)]
#![allow(clippy::doc_markdown, clippy::too_many_arguments)]

#[rustfmt::skip]
mod generated;

pub use generated::*;
