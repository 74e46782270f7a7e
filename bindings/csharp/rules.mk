# make csharp tests the binding with Mono; csharp-cost says what calls cost; package-csharp makes packages of Unity and NuGet.

LANGUAGE_CHECKS += csharp
WANTS_test-all += mono-mcs mono-runtime

.PHONY: csharp csharp-tests csharp-cost package-csharp

CSHARP := build/csharp
CSHARP_RUNTIME := $(wildcard bindings/csharp/Runtime/*.cs)
CSHARP_UNITY := $(wildcard bindings/csharp/Runtime/Unity/*.cs)
CSHARP_TESTS := $(addprefix bindings/csharp/Tests/,Layout.cs Tests.cs UnityStubs.cs)
MCS = mcs -nologo -unsafe -optimize -langversion:7.2 -warnaserror -nowarn:649,1591
DOTNET ?= dotnet
CSHARP_RUN = LD_LIBRARY_PATH='$(CURDIR)/$(BUILD)' mono

# The library, and with the components of Unity the tests.
$(CSHARP)/tests.exe: $(CSHARP_RUNTIME) $(CSHARP_UNITY) $(CSHARP_TESTS) bindings/csharp/Tests/Twin.cs bindings/csharp/Tests/FirstCut.cs
	@mkdir -p $(CSHARP)
	@$(MCS) -target:library -doc:$(CSHARP)/Kiri.xml -out:$(CSHARP)/Kiri.dll $(CSHARP_RUNTIME)
	@$(MCS) -r:$(CSHARP)/Kiri.dll -out:$(CSHARP)/first_cut.exe bindings/csharp/Tests/FirstCut.cs
	@$(MCS) -r:$(CSHARP)/Kiri.dll -out:$(CSHARP)/twin.exe bindings/csharp/Tests/Twin.cs
	@$(MCS) -define:KIRI_UNITY -main:Kiri.Tests.Tests -out:$@ $(CSHARP_RUNTIME) $(CSHARP_UNITY) $(CSHARP_TESTS) bindings/csharp/Tests/Twin.cs

# What the submake shares with other targets is there before: two makes at a time must not make the same file.
csharp: $(BUILD)/libkiri.so $(BUILD)/tests/twin
	@if ! command -v mcs > /dev/null || ! command -v mono > /dev/null; then echo "csharp: no mono, binding not tested"; \
	else $(MAKE) --no-print-directory csharp-tests; fi

csharp-tests: $(CSHARP)/tests.exe $(BUILD)/libkiri.so $(BUILD)/tests/twin
	@set -e; echo "== bindings/csharp"; \
	$(CSHARP_RUN) $(CSHARP)/tests.exe . > $(CSHARP)/log 2>&1 || { cat $(CSHARP)/log; exit 1; }; tail -n 1 $(CSHARP)/log; \
	$(CSHARP_RUN) $(CSHARP)/first_cut.exe | grep -qx '2 pieces' || { echo "csharp: the first cut gives no 2 pieces"; exit 1; }; \
	$(CSHARP_RUN) $(CSHARP)/twin.exe > $(CSHARP)/twin.txt; $(BUILD)/tests/twin | head -n 2 | cmp - $(CSHARP)/twin.txt; \
	if command -v $(DOTNET) > /dev/null; then \
	    echo '{"runtimeOptions":{"framework":{"name":"Microsoft.NETCore.App","version":"3.1.0"},"rollForward":"Major"}}' > $(CSHARP)/core.json; \
	    DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 LD_LIBRARY_PATH='$(CURDIR)/$(BUILD)' $(DOTNET) exec --runtimeconfig $(CSHARP)/core.json \
	        $(CSHARP)/twin.exe | cmp - $(CSHARP)/twin.txt; else echo "csharp: no dotnet, not tested in .NET"; fi; \
	echo "csharp: tests pass, and the hash is that of C: $$(head -n 1 $(CSHARP)/twin.txt)"

csharp-cost: $(BUILD)/libkiri.so $(CSHARP)/tests.exe
	@$(CSHARP_RUN) $(CSHARP)/tests.exe . cost

# The first program is built from the sources of the one package, and with the assembly of the other, and run with the
# library that each brings.
CSHARP_CLEAN := $(CSHARP)/clean

package-csharp: $(BUILD)/libkiri.so $(CSHARP)/tests.exe
	@set -e; $(PYTHON) bindings/csharp/pack.py $(VERSION) $(BUILD)/libkiri.so $(CSHARP)/Kiri.dll $(CSHARP); \
	rm -rf $(CSHARP_CLEAN); mkdir -p $(CSHARP_CLEAN)/unity $(CSHARP_CLEAN)/nuget; \
	tar xzf $(CSHARP)/com.kiri.kiri-$(VERSION).tgz -C $(CSHARP_CLEAN)/unity; \
	$(PYTHON) -m zipfile -e $(CSHARP)/Kiri.$(VERSION).nupkg $(CSHARP_CLEAN)/nuget; cp bindings/csharp/Tests/FirstCut.cs $(CSHARP_CLEAN); \
	cd $(CSHARP_CLEAN); $(MCS) -out:unity.exe FirstCut.cs unity/package/Runtime/*.cs; cp nuget/lib/net45/Kiri.dll .; $(MCS) -r:Kiri.dll -out:nuget.exe FirstCut.cs; \
	LD_LIBRARY_PATH=unity/package/Plugins/x86_64 mono unity.exe | grep -qx '2 pieces'; \
	LD_LIBRARY_PATH=nuget/runtimes/linux-x64/native mono nuget.exe | grep -qx '2 pieces'; \
	$(PYTHON) -c "import xml.etree.ElementTree as tree; assert len(tree.parse('nuget/lib/net45/Kiri.xml').findall('.//member')) > 300; \
	    project = tree.parse('$(CURDIR)/bindings/csharp/Kiri.csproj'); assert project.findtext('.//TargetFrameworks') == 'netstandard2.0;net8.0'"; \
	for file in $$(find unity/package/*/ ! -name '*.meta'); do [ -e "$${file%/}.meta" ] || { echo "csharp: $$file has no .meta"; exit 1; }; done; \
	if [ -n "$$($(DOTNET) --list-sdks 2> /dev/null)" ]; then cd '$(CURDIR)'; \
	    $(DOTNET) pack bindings/csharp -o $(CSHARP) -p:Version=$(VERSION) -p:KiriLibrary='$(CURDIR)/$(BUILD)/libkiri.so'; \
	    $(PYTHON) -c "import zipfile; names = zipfile.ZipFile('$(CSHARP)/Kiri.$(VERSION).nupkg').namelist(); \
	        assert {'lib/netstandard2.0/Kiri.xml', 'lib/net8.0/Kiri.xml', 'runtimes/linux-x64/native/libkiri.so'} <= set(names), names"; \
	else echo "csharp: no SDK of .NET, Kiri.csproj not tested"; fi; \
	echo "csharp: $(CSHARP)/com.kiri.kiri-$(VERSION).tgz and Kiri.$(VERSION).nupkg, and a program of the two cuts"
