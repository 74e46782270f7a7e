# The binding for LuaJIT. `make lua` tests it; `make package-lua` makes a rock of it, and tests that.

LANGUAGE_CHECKS += lua
WANTS_test-all += luajit
LUAJIT ?= luajit

.PHONY: lua package-lua bench-lua

lua: $(BUILD)/libkiri.so $(BUILD)/tests/twin
	@if ! command -v $(LUAJIT) > /dev/null; then echo "lua: no $(LUAJIT), binding not tested"; exit 0; fi; \
	echo "== tests/test_lua.lua"; KIRI_LIBRARY=$< $(LUAJIT) tests/test_lua.lua $(BUILD)/tests/twin

# What calls cost.
bench-lua: $(BUILD)/libkiri.so
	@KIRI_LIBRARY=$< $(LUAJIT) bindings/lua/bench.lua

# A rock in build/rock, and the first program by it alone, in an empty folder.
ROCK := $(CURDIR)/build/rock

package-lua:
	@if ! command -v luarocks > /dev/null; then echo "package-lua: no luarocks, no rock made"; exit 0; fi; \
	rm -rf $(ROCK) build/rock-test && mkdir -p build/rock-test && \
	luarocks --lua-version 5.1 --tree $(ROCK) make bindings/lua/kiri-$(VERSION)-1.rockspec > build/rock-test/luarocks.log 2>&1 || \
	    { cat build/rock-test/luarocks.log; exit 1; }; \
	sed '/^package.path/d' bindings/lua/first_cut.lua > build/rock-test/first_cut.lua; \
	cd build/rock-test && env -u KIRI_LIBRARY LUA_PATH='$(ROCK)/share/lua/5.1/?.lua' LUA_CPATH='$(ROCK)/lib/lua/5.1/?.so' \
	    $(LUAJIT) first_cut.lua

# The game plays itself, and is looked at: pictures are in build/love.
.PHONY: love love-test

NEEDS_love := $(NEEDS_lib) love

love: packages-love
	@$(MAKE) --no-print-directory $(BUILD)/libkiri.so
	KIRI_LIBRARY=$(CURDIR)/$(BUILD)/libkiri.so love samples/love

love-test: $(BUILD)/libkiri.so
	@KIRI_LIBRARY=$(CURDIR)/$< sh samples/love/test.sh build/love
