# The binding for Go (1.24 or later). `make go` tests it; `make package-go` makes a module with the library's sources inside,
# and uses it.

LANGUAGE_CHECKS += go
GO ?= go
GO_RUN = GOTOOLCHAIN=local GOFLAGS=-mod=mod GOPROXY=off $(GO)
GO_IS_THERE = $(GO) version 2> /dev/null | grep -qE 'go(1\.(2[4-9]|[3-9][0-9])|[2-9])'

# Go takes no -ffp-contract. x86-64 without further options has no fused operations.
NO_CONTRACTION = '\#if defined(__clang__)' '\#pragma STDC FP_CONTRACT OFF' '\#elif !defined(__x86_64__)' \
    '\#pragma GCC optimize("fp-contract=off")' '\#endif'

.PHONY: go package-go bench-go

go: $(BUILD)/libkiri.so $(BUILD)/tests/twin
	@if ! { $(GO_IS_THERE); }; then echo "go: no go 1.24 or later, binding not tested"; exit 0; fi; \
	echo "== bindings/go"; cd bindings/go && { [ -z "$$(gofmt -l . 2> /dev/null)" ] || { gofmt -d . ; exit 1; }; } && KIRI_TWIN=$(CURDIR)/$(BUILD)/tests/twin $(GO_RUN) test -count 1 ./ && \
	[ "$$($(GO_RUN) run ./first_cut)" = "2 pieces" ]

bench-go: $(BUILD)/libkiri.so
	@cd bindings/go && $(GO_RUN) test -bench . -benchtime 1000x -count 50 -run NONE ./ | \
	    awk '/^Benchmark/ { if (!($$1 in least) || $$3 < least[$$1]) least[$$1] = $$3 } \
	        END { for (name in least) print name, least[name], "ns" }'

# A module in build/go/kiri, and a program that has only that.
package-go: single
	@if ! { $(GO_IS_THERE); }; then echo "package-go: no go 1.24 or later, no module made"; exit 0; fi; \
	rm -rf build/go && mkdir -p build/go/kiri/kiri build/go/test && \
	cp bindings/go/go.mod bindings/go/kiri.go bindings/go/world.go bindings/go/README.md LICENSE \
	    build/single/kiri.h build/go/kiri && \
	cp build/single/kiri.h build/go/kiri/kiri && \
	for file in kiri.c kiri.cpp; do { printf '%s\n' $(NO_CONTRACTION); cat build/single/$$file; } > build/go/kiri/$$file; done && \
	printf '%s\n' 'package kiri' '' '// Eigen is found by pkg-config, or where Debian has it.' '' \
	    '// #cgo CFLAGS: -I$${SRCDIR} -O3 -DNDEBUG' \
	    '// #cgo CXXFLAGS: -I$${SRCDIR} -std=c++14 -O3 -DNDEBUG -I/usr/include/eigen3' \
	    '// #cgo LDFLAGS: -lm' 'import "C"' > build/go/kiri/build.go && \
	cp bindings/go/first_cut/main.go build/go/test && \
	printf '%s\n' 'module first' '' 'go 1.24' '' 'require example.com/kiri v0.0.0' '' 'replace example.com/kiri => ../kiri' > build/go/test/go.mod && \
	cd build/go/test && $(GO_RUN) build -o first_cut . && ./first_cut
