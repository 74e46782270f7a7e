# make package-debian builds packages of Debian from a source package, and a program with what they install.

.PHONY: package-debian

DEBIAN := build/debian
DEBIAN_SOURCE := $(DEBIAN)/kiri-$(VERSION)
DEBIAN_ROOT := $(CURDIR)/$(DEBIAN)/root

# The program of the README, by pkg-config, with the packages in a folder of their own.
package-debian: single
	@if ! command -v dh > /dev/null; then echo "package-debian: no debhelper, no package made"; exit 0; fi; \
	set -e; rm -rf $(DEBIAN); mkdir -p $(DEBIAN_SOURCE)/debian/source; \
	tar -c --exclude=./build --exclude=./.git . | tar -x -C $(DEBIAN_SOURCE); \
	cp bindings/debian/rules bindings/debian/copyright $(DEBIAN_SOURCE)/debian; \
	sed 's|@SOVERSION@|$(SOVERSION)|' bindings/debian/control.in > $(DEBIAN_SOURCE)/debian/control; \
	echo 'usr/lib/*/libkiri.so.*' > $(DEBIAN_SOURCE)/debian/libkiri$(SOVERSION).install; \
	printf 'usr/%s\n' include 'lib/*/libkiri.a' 'lib/*/libkiri.so' 'lib/*/pkgconfig' 'lib/*/cmake' > $(DEBIAN_SOURCE)/debian/libkiri-dev.install; \
	echo '3.0 (native)' > $(DEBIAN_SOURCE)/debian/source/format; \
	printf 'kiri ($(VERSION)) unstable; urgency=medium\n\n  * See .github/CHANGELOG.md.\n\n -- %s  %s\n' \
	    "$$(sed -n 's/^Maintainer: //p' bindings/debian/control.in)" "$$(date -R -r .github/CHANGELOG.md)" > $(DEBIAN_SOURCE)/debian/changelog; \
	(cd $(DEBIAN_SOURCE) && env -u MAKEFLAGS -u MAKELEVEL dpkg-buildpackage -us -uc) > $(DEBIAN)/log 2>&1 || { tail -n 30 $(DEBIAN)/log; exit 1; }; \
	if command -v lintian > /dev/null; then (cd $(DEBIAN) && lintian --fail-on error,warning *.dsc *.deb); fi; \
	for package in $(DEBIAN)/lib*_*.deb; do dpkg-deb -x $$package $(DEBIAN_ROOT); done; \
	sed -n '/^```c$$/,/^```$$/p' README.md | sed '/^```/d' > $(DEBIAN)/example.c; \
	libraries=$$(dirname $(DEBIAN_ROOT)/usr/lib/*/libkiri.so); \
	export PKG_CONFIG_SYSROOT_DIR=$(DEBIAN_ROOT) PKG_CONFIG_LIBDIR=$$libraries/pkgconfig; \
	$(CC) -std=c99 $(DEBIAN)/example.c $$(pkg-config --cflags --libs kiri) -o $(DEBIAN)/example; \
	LD_LIBRARY_PATH=$$libraries $(DEBIAN)/example; \
	dpkg-deb -f $(DEBIAN)/libkiri$(SOVERSION)_*.deb Depends | grep -q libc6; \
	echo "  $(DEBIAN): $$(cd $(DEBIAN) && ls *.dsc *.deb | paste -sd ' ')"
