package kiri

// In a checkout: the library that `make lib` builds. The module that `make package-go` makes has the sources instead.

// #cgo CFLAGS: -I${SRCDIR}/../../include
// #cgo LDFLAGS: -L${SRCDIR}/../../build/release -lkiri -Wl,-rpath,${SRCDIR}/../../build/release
import "C"
