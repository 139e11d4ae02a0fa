// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <umbilic/core/progress.h>

namespace umbilic {

// What passes through the pipe from the reader to its caller: frames of one letter, eight bytes of length
// (little-endian) and the contents.
namespace reader_frame {
inline constexpr char progress = 'P';          ///< fraction as 8 bytes, then the name of the stage
inline constexpr char result = 'R';            ///< the last frame of a run that succeeded
inline constexpr char invalid_input = 'I';     ///< the last frame of a run that failed; the message
inline constexpr char unsupported = 'U';       ///< likewise
inline constexpr char numeric_failure = 'N';   ///< likewise
inline constexpr char out_of_memory = 'M';     ///< likewise, no message
inline constexpr std::size_t header_size = 9;  ///< letter and length
}  // namespace reader_frame

/// File descriptor on which the reader writes its frames.
inline constexpr int reader_output = 3;

struct ReaderLimits {
    double seconds = 0.0;
    std::uint64_t memory = 0;  ///< bytes of address space
};

/// Runs the program umbilic_reader with these arguments (after the memory limit, its first argument) and returns the
/// contents of its result frame. `path` is named in errors. Throws what the reader reports; InvalidInput if it dies;
/// NumericFailure at a limit or if the program is not found; Cancelled. Whatever happens, the process is gone when
/// this returns.
std::string run_reader(const std::string& path, const std::vector<std::string>& arguments, const ReaderLimits& limits,
                       const Progress& progress);

/// Place of the program: $UMBILIC_READER, beside the running program or the library this code is in (or in
/// ../libexec/umbilic from there), then where it was installed or built. Throws NumericFailure if it is nowhere.
std::string reader_program();

}  // namespace umbilic
