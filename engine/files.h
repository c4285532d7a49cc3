// Reading and writing whole files: atomic writes, clear faults.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

std::string read_text(const std::filesystem::path& file);               // throws Error; at most 256 MiB
std::vector<std::uint32_t> read_spirv(const std::filesystem::path& file);
// Writes `FILE.tmp-PID` and renames it over `file`; on any fault (full disk, no permission) the temporary file is removed and Error
// thrown. Parent folders must exist.
void write_atomically(const std::filesystem::path& file, std::string_view bytes);
// Makes the folder and its parents, and proves that it can be written to. Throws Error.
void make_output_directory(const std::filesystem::path& directory);
std::filesystem::path executable_directory();

}  // namespace seascape
