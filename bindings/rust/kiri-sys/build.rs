//! Builds the library: from the files that the crate has, or from the repository that it stands in.
//!
//! KIRI_LIBRARY_DIR: links to the libkiri.a there, and builds nothing. EIGEN_DIR: where the headers of Eigen are; else
//! pkg-config says it. DOCS_RS: documentation alone is made, which takes no library.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

fn main() {
    for name in ["KIRI_LIBRARY_DIR", "EIGEN_DIR", "DOCS_RS"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    if env::var_os("DOCS_RS").is_some() {
        return;
    }
    if let Some(folder) = env::var_os("KIRI_LIBRARY_DIR") {
        let folder = Path::new(&folder);
        println!("cargo:rerun-if-changed={}", folder.join("libkiri.a").display());
        println!("cargo:rustc-link-search=native={}", folder.display());
        println!("cargo:rustc-link-lib=static=kiri");
        link_cpp();
    } else {
        build();
    }
}

/// The C++ standard library that cc would link to.
fn link_cpp() {
    let target = env::var("TARGET").unwrap();
    if target.contains("apple") || target.contains("bsd") {
        println!("cargo:rustc-link-lib=c++");
    } else if !target.contains("msvc") {
        println!("cargo:rustc-link-lib=stdc++");
    }
}

fn build() {
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap());
    let (include, sources) = sources(&here);
    for source in &sources {
        println!("cargo:rerun-if-changed={}", source.display());
    }
    let (cpp, c): (Vec<_>, Vec<_>) =
        sources.into_iter().partition(|path| path.extension().is_some_and(|of| of == "cpp"));
    common(cc::Build::new().files(c).include(&include).std("c99")).compile("kiri_c");
    common(cc::Build::new().cpp(true).files(cpp).include(&include).include(eigen()).std("c++14")).compile("kiri_cpp");
}

/// A fused multiply-add would give other bits than other machines do.
fn common(build: &mut cc::Build) -> &mut cc::Build {
    build
        .opt_level(3)
        .debug(false)
        .warnings(false)
        .define("NDEBUG", None)
        .flag_if_supported("-ffp-contract=off")
        .flag_if_supported("-fno-math-errno")
        .flag_if_supported("-fvisibility=hidden")
}

/// The folder to include from, and the files.
fn sources(here: &Path) -> (PathBuf, Vec<PathBuf>) {
    let packed = here.join("library");
    if packed.is_dir() {
        return (packed.clone(), vec![packed.join("kiri.c"), packed.join("kiri.cpp")]);
    }
    let root = here.join("../../..");
    let mut files = Vec::new();
    for floor in fs::read_dir(root.join("src")).expect("sources of the library").flatten() {
        if floor.path().is_dir() {
            files.extend(
                fs::read_dir(floor.path())
                    .unwrap()
                    .flatten()
                    .map(|entry| entry.path())
                    .filter(|path| path.extension().is_some_and(|of| of == "c" || of == "cpp")),
            );
        }
    }
    files.sort();
    (root.join("include"), files)
}

fn eigen() -> PathBuf {
    if let Some(folder) = env::var_os("EIGEN_DIR") {
        return folder.into();
    }
    let flags = Command::new("pkg-config").args(["--cflags-only-I", "eigen3"]).output();
    let flags = flags.map(|output| String::from_utf8_lossy(&output.stdout).into_owned()).unwrap_or_default();
    flags.trim().strip_prefix("-I").unwrap_or("/usr/include/eigen3").into()
}
