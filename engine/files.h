// Reading and writing whole files: atomic writes, clear faults.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

inline constexpr std::size_t largest_file_bytes = std::size_t{256} << 20;

// Both throw Error: missing, a folder, no permission, over `most_bytes`. Pipes, terminals and devices are read to their
// end; after a second a line on stderr tells what is waited for.
std::string read_text(const std::filesystem::path& file, std::size_t most_bytes = largest_file_bytes);
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file, std::size_t most_bytes = largest_file_bytes);
// A SPIR-V module in this machine's byte order, magic number and size checked. Throws Error.
std::vector<std::uint32_t> read_spirv(const std::filesystem::path& file);
// Writes `FILE.tmp-PID-N` and renames it over `file`; on any fault (full disk, no permission) the temporary file is
// removed and Error thrown, and what `file` held before is untouched. Parent folders must exist. A symbolic link keeps
// pointing at its target, which is replaced; a device, pipe or descriptor (/dev/stdout, whatever is behind it) is
// written to as it is. A stop signal waits until the file is whole. Safe from several threads.
void write_atomically(const std::filesystem::path& file, std::string_view bytes);
void write_atomically(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
// Makes the folder and its parents, and proves that it can be written to. Throws Error.
void make_output_directory(const std::filesystem::path& directory);
// Makes an empty file FOLDER/STEM_001ENDING, or the next number that is free, so that nobody else takes the name. Makes
// the folder. Throws Error.
std::filesystem::path make_numbered_file(const std::filesystem::path& folder, const std::string& stem,
                                         const std::string& ending);
// Whether both are names of one plain file, by links of either kind too.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);
std::filesystem::path executable_directory();

}  // namespace seascape
