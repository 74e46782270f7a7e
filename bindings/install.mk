# make install, make uninstall; make consumers builds a program in each way to use the library; make abi compares what
# programs rely on with the last version, of which make abi-list keeps it.
#
#   PREFIX=/usr/local   libdir, includedir: below it
#   DESTDIR=            goes before all of them, for those who make packages

PREFIX ?= /usr/local
libdir ?= $(PREFIX)/lib
includedir ?= $(PREFIX)/include
DESTDIR ?=
INSTALL_LIBRARY := $(DESTDIR)$(libdir)
INSTALL_HEADER := $(DESTDIR)$(includedir)/kiri

# All that is installed.
INSTALLED = '$(INSTALL_HEADER)/kiri.h' $(patsubst %,'$(INSTALL_LIBRARY)/%',libkiri.a libkiri.so libkiri.so.$(SOVERSION) \
    libkiri.so.$(VERSION) pkgconfig/kiri.pc cmake/kiri/kiri-config.cmake cmake/kiri/kiri-config-version.cmake)

# Fills in a template. The package of CMake names its folders by the way from its own, so that a prefix can be moved.
FILL = sed -e 's|@VERSION@|$(VERSION)|' -e 's|@SOVERSION@|$(SOVERSION)|' -e 's|@PREFIX@|$(PREFIX)|' \
    -e 's|@libdir@|$(libdir)|' -e 's|@includedir@|$(includedir)|' \
    -e "s|@way@|$$(realpath -m --relative-to='$(libdir)/cmake/kiri' '$(includedir)')|"

.PHONY: install uninstall consumers abi abi-list

install: lib
	install -d '$(INSTALL_HEADER)' '$(INSTALL_LIBRARY)/pkgconfig' '$(INSTALL_LIBRARY)/cmake/kiri'
	install -m 644 include/kiri/kiri.h '$(INSTALL_HEADER)'
	install -m 644 $(BUILD)/libkiri.a '$(INSTALL_LIBRARY)'
	install -m 755 $(BUILD)/libkiri.so.$(VERSION) '$(INSTALL_LIBRARY)'
	ln -sf libkiri.so.$(VERSION) '$(INSTALL_LIBRARY)/libkiri.so.$(SOVERSION)'
	ln -sf libkiri.so.$(SOVERSION) '$(INSTALL_LIBRARY)/libkiri.so'
	$(FILL) bindings/pkgconfig/kiri.pc.in > '$(INSTALL_LIBRARY)/pkgconfig/kiri.pc'
	$(FILL) bindings/cmake/kiri-config.cmake.in > '$(INSTALL_LIBRARY)/cmake/kiri/kiri-config.cmake'
	$(FILL) bindings/cmake/kiri-config-version.cmake.in > '$(INSTALL_LIBRARY)/cmake/kiri/kiri-config-version.cmake'
	@[ -n '$(DESTDIR)' ] || [ "$$(id -u)" != 0 ] || ! command -v ldconfig > /dev/null || ldconfig

# Folders that are empty then go too, but for those that others use.
uninstall:
	rm -f $(INSTALLED)
	-rmdir '$(INSTALL_HEADER)' '$(INSTALL_LIBRARY)/cmake/kiri' 2> /dev/null

consumers: lib example
	@CONFIG=$(config) EIGEN='$(EIGEN)' CC='$(CC)' CXX='$(CXX)' sh tests/consumer/run.sh

# The last version is that of the last tag, or where there is none the list as it is.
ABI_LIST := tests/data/abi.txt

abi: $(BUILD)/libkiri.so
	@list=$(ABI_LIST); tag=$$(git describe --tags --abbrev=0 2> /dev/null); \
	if [ -n "$$tag" ] && git show "$$tag:$$list" > $(BUILD)/abi.txt 2> /dev/null; then list=$(BUILD)/abi.txt; fi; \
	$(PYTHON) tests/abi.py $< $$list

abi-list: $(BUILD)/libkiri.so
	$(PYTHON) tests/abi.py $< $(ABI_LIST) --write
