#pragma once

namespace carom::detail {

/// The type of sums over all disks. WebAssembly has no arithmetic wider than double but by calls, which took more time than to
/// fly the disks; no page shows the digits that are lost there.
#if defined(__wasm__)
using Wide = double;
#else
using Wide = long double;
#endif

}  // namespace carom::detail
