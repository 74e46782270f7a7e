"""C#: Native.cs has the functions and structs as C lays them out, Kiri.cs classes over them, Layout.cs a test of both."""

import csharp_methods
import csharp_native


def files(description):
    return {
        "bindings/csharp/Runtime/Native.cs": csharp_native.Native(description).text(),
        "bindings/csharp/Runtime/Kiri.cs": csharp_methods.Methods(description).text(),
        "bindings/csharp/Tests/Layout.cs": csharp_native.Native(description).layout_test(),
    }
