"""Rust: the crates kiri-sys and kiri."""

import rust_raw
import rust_safe

WORKSPACE = """# Made from kiri.h by `make bindings`.
[workspace]
members = ["kiri-sys", "kiri"]
resolver = "2"

[workspace.package]
version = "{version}"
edition = "2021"
rust-version = "1.82"
license = "MIT"
categories = ["game-development", "simulation"]
keywords = ["cloth", "cutting", "physics", "simulation"]

[workspace.dependencies]
kiri-sys = {{ path = "kiri-sys", version = "={version}" }}
"""


def files(description):
    return {
        "bindings/rust/Cargo.toml": WORKSPACE.format(version=description["version"]),
        "bindings/rust/kiri-sys/src/generated.rs": rust_raw.Raw(description).text(),
        "bindings/rust/kiri/src/generated.rs": rust_safe.Safe(description).text(),
    }
