#include "engine/gltf_document.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"
#include "engine/tinygltf_library.h"

namespace seascape {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int deepest_json = 64;  // nesting; tinygltf recurses
constexpr std::size_t most_json_values = std::size_t{1} << 20;
constexpr std::size_t most_buffer_bytes = std::size_t{512} << 20;  // all buffers together
constexpr std::string_view supported_extensions[] = {"KHR_mesh_quantization", "KHR_materials_emissive_strength",
                                                     "KHR_materials_unlit", "KHR_texture_transform", "MSFT_lod"};

[[noreturn]] void fail(const std::string& where, const std::string& what,
                       const char* remedy = "export the model again") {
  throw Error(where, what, remedy);
}

std::uint32_t little_endian(const std::uint8_t* at) {
  return std::uint32_t{at[0]} | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16 | std::uint32_t{at[3]} << 24;
}

void append_word(std::vector<std::uint8_t>& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

struct Chunks {
  std::string_view text;
  std::span<const std::uint8_t> binary;
  bool packed = false;  // a .glb
};

// glTF 2.0, section 4.4: a 12-byte header, a JSON chunk, then at most one binary chunk that is read here.
Chunks split(std::span<const std::uint8_t> bytes, const std::string& where) {
  const auto as_text = [](std::span<const std::uint8_t> part) {
    return std::string_view(reinterpret_cast<const char*>(part.data()), part.size());
  };
  if (bytes.size() < 4 || as_text(bytes.first(4)) != "glTF") return {as_text(bytes), {}, false};
  if (bytes.size() < 20) fail(where, "is cut off", "copy it again");
  if (little_endian(bytes.data() + 4) != 2) fail(where, "is not glTF version 2");
  const std::size_t length = little_endian(bytes.data() + 8);
  if (length > bytes.size()) fail(where, "is cut off", "copy it again");
  if (length < 20) fail(where, "is a broken .glb (its length is wrong)");
  std::span<const std::uint8_t> rest = bytes.first(length).subspan(12);
  const std::size_t json_bytes = little_endian(rest.data());
  if (little_endian(rest.data() + 4) != 0x4E4F534A) fail(where, "is a broken .glb (it does not start with JSON)");
  if (json_bytes > rest.size() - 8) fail(where, "is a broken .glb (its JSON is cut off)");
  Chunks chunks{as_text(rest.subspan(8, json_bytes)), {}, true};
  rest = rest.subspan(8 + json_bytes);
  if (rest.size() < 8) return chunks;
  const std::size_t binary_bytes = little_endian(rest.data());
  if (little_endian(rest.data() + 4) == 0x004E4942) {
    if (binary_bytes > rest.size() - 8) fail(where, "is a broken .glb (its binary data is cut off)");
    chunks.binary = rest.subspan(8, binary_bytes);
  }
  return chunks;
}

// Counts while the text is read, before any tree is made, so that a small file cannot become a huge one. (nlohmann's
// parser with a callback would do, but takes quadratic time on a long list of objects.)
class Limits : public nlohmann::json_sax<json> {
 public:
  explicit Limits(const std::string& where) : where_(where) {}
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool key(string_t&) override { return value(); }
  bool start_object(std::size_t) override { return deeper(); }
  bool start_array(std::size_t) override { return deeper(); }
  bool end_object() override { return --depth_, true; }
  bool end_array() override { return --depth_, true; }
  bool parse_error(std::size_t at, const std::string&, const json::exception&) override {
    fault_at_ = at;
    return false;
  }
  std::size_t fault_at() const { return fault_at_; }

 private:
  bool value() {
    if (++values_ > most_json_values) fail(where_, fmt::format("has more than {} JSON values", most_json_values));
    return true;
  }
  bool deeper() {
    if (++depth_ > deepest_json) fail(where_, fmt::format("is nested deeper than {} levels", deepest_json));
    return value();
  }

  const std::string& where_;
  int depth_ = 0;
  std::size_t values_ = 0, fault_at_ = 0;
};

json parse_json(std::string_view text, const std::string& where, bool packed) {
  if (packed)  // some writers pad with zeros where the format asks for spaces
    while (text.ends_with('\0')) text.remove_suffix(1);
  if (text.find('\0') != text.npos)  // the parser would take it for the end
    fail(where, "has a zero byte in its JSON", "save it as UTF-8 text, or export it again");
  Limits limits(where);
  if (!json::sax_parse(text.begin(), text.end(), &limits)) {
    const std::size_t at = std::min(limits.fault_at(), text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw Error(fmt::format("{}:{}", where, line), "is not valid JSON",
                "a .gltf file starts with {; mend it or export it again");
  }
  return json::parse(text.begin(), text.end());
}

void check_asset(const json& root, const std::string& where) {
  if (!root.is_object()) fail(where, "is not a glTF file (its JSON is not an object)", "give a glTF 2.0 model");
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object() || !asset->contains("version") || !(*asset)["version"].is_string())
    fail(where, "is not a glTF file (it has no asset.version)", "give a glTF 2.0 model");
  const std::string version = (*asset)["version"].get<std::string>();
  if (!version.starts_with("2."))
    fail(where, fmt::format("is glTF version {}, not 2", version), "convert it to glTF 2.0");
  const auto least = asset->find("minVersion");
  if (least != asset->end() && *least != "2.0") fail(where, "needs a newer glTF than 2.0", "export it as glTF 2.0");
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return;
  if (!required->is_array()) fail(where, "extensionsRequired is not a list");
  for (const json& name : *required) {
    if (!name.is_string()) fail(where, "extensionsRequired holds something that is not a name");
    const std::string text = name.get<std::string>();
    if (std::find(std::begin(supported_extensions), std::end(supported_extensions), text) ==
        std::end(supported_extensions))
      fail(where, fmt::format("requires the extension {}, which is not supported", text),
           "export it without that extension");
  }
}

// Where tinygltf may read from, and how much; and why it may not, where it may not.
struct Reach {
  fs::path folder;
  std::size_t left = most_buffer_bytes;
  std::string refusal;
};

// Why FOLDER/uri may not be read; empty: it may. Only a regular file below the folder counts, links followed.
std::string refusal(const fs::path& folder, const std::string& name) {
  std::error_code fault;
  const fs::path real = fs::weakly_canonical(name, fault);
  const bool below =
      !fault && std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end();
  if (below && fs::is_regular_file(real, fault)) return {};
  const std::string uri = name.substr(std::min(name.size(), folder.string().size() + 1));
  const fs::file_status status = fs::status(real, fault);
  return in_quotes(uri, 200) + (!below || uri.starts_with('/') ? " lies outside of the model's folder"
                                : fs::is_directory(status)     ? " is a folder"
                                : fs::exists(status)           ? " is no plain file"
                                                               : " is not there");
}

// tinygltf asks for FOLDER/uri, then for ./uri.
bool inside(const std::string& name, void* user) {
  Reach& reach = *static_cast<Reach*>(user);
  if (reach.folder.empty() || !fs::path(name).is_absolute()) return false;
  const std::string why = refusal(reach.folder, name);
  if (!why.empty()) reach.refusal = "its buffer " + why;
  return why.empty();
}

std::string same_path(const std::string& name, void*) { return name; }

bool read_buffer(std::vector<unsigned char>* out, std::string* fault, const std::string& name, void* user) {
  Reach& reach = *static_cast<Reach*>(user);
  try {
    *out = read_bytes(name, std::min(reach.left, largest_file_bytes));
    reach.left -= out->size();
    return true;
  } catch (const Error& error) {
    *fault += error.fault();
    return false;
  }
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

// In a .glb only buffer 0 may stand for the binary chunk; otherwise a small file could ask for many copies of it.
void check_buffers(const json& root, bool packed, const std::string& where) {
  const auto buffers = root.find("buffers");
  if (buffers == root.end()) return;
  if (!buffers->is_array()) fail(where, "buffers is not a list");
  for (std::size_t i = 0; i < buffers->size(); ++i) {
    const json& buffer = (*buffers)[i];
    if (!buffer.is_object()) fail(where, fmt::format("buffer {} is not an object", i));
    const auto uri = buffer.find("uri");
    const auto size = buffer.find("byteLength");
    if (uri != buffer.end() && (!uri->is_string() || uri->get_ref<const std::string&>().empty()))
      fail(where, fmt::format("buffer {} has a uri that is not a name", i));
    if (uri == buffer.end() && (!packed || i != 0)) fail(where, fmt::format("buffer {} has no uri", i));
    if (uri != buffer.end() && uri->get_ref<const std::string&>().find("://") != std::string::npos)
      fail(where, fmt::format("buffer {} is at the address {}", i, in_quotes(uri->get_ref<const std::string&>(), 200)),
           "copy it beside the model and name that file");
    if (size == buffer.end() || !size->is_number_unsigned() || size->get<std::uint64_t>() == 0 ||
        size->get<std::uint64_t>() > most_buffer_bytes)
      fail(where, fmt::format("buffer {} has a byteLength that is not 1 to {}", i, most_buffer_bytes));
  }
}

std::string first_line(const std::string& text) {
  std::string line = text.substr(0, std::min<std::size_t>(text.find('\n'), 300));
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  return line.empty() ? "its contents do not fit the format" : line;
}

// tinygltf hands bytes of pictures out without a look at where their buffer ends, so it never sees them.
std::vector<GltfPicture> pictures_of(const json& root, const std::string& where) {
  std::vector<GltfPicture> found;
  const auto images = root.find("images");
  if (images == root.end()) return found;
  if (!images->is_array()) fail(where, "images is not a list");
  for (std::size_t i = 0; i < images->size(); ++i) {
    const json& image = (*images)[i];
    GltfPicture& picture = found.emplace_back();
    const auto view = image.is_object() ? image.find("bufferView") : image.end();
    const auto uri = image.is_object() ? image.find("uri") : image.end();
    if (view != image.end() && view->is_number_unsigned() && view->get<std::uint64_t>() < most_json_values)
      picture.view = view->get<int>();
    else if (uri != image.end() && uri->is_string() && !uri->get_ref<const std::string&>().empty())
      picture.uri = uri->get<std::string>();
    else
      fail(where, fmt::format("picture {} has neither a buffer view nor a file", i));
  }
  return found;
}

// RFC 3986, section 2.1.
std::string percent_decoded(const std::string& uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    decoded += coded ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return decoded;
}

}  // namespace

fs::path gltf_file_below(const fs::path& folder, const std::string& uri, const std::string& where) {
  if (folder.empty() || uri.find("://") != std::string::npos)
    fail(where, "its picture " + in_quotes(uri, 200) + " cannot be read from there",
         "copy it beside the model and name that file");
  std::error_code fault;
  const fs::path real = fs::canonical(folder, fault);
  const std::string name = real.string() + "/" + percent_decoded(uri);
  if (const std::string why = refusal(real, name); !why.empty())
    fail(where, "its picture " + why, "put its pictures beside it, or export it again");
  return name;
}

tinygltf::Model parse_gltf(std::span<const std::uint8_t> bytes, const fs::path& folder, const std::string& where,
                           std::vector<GltfPicture>* pictures) {
  const Chunks chunks = split(bytes, where);
  json root = parse_json(chunks.text, where, chunks.packed);
  check_asset(root, where);
  check_buffers(root, chunks.packed, where);
  if (pictures) *pictures = pictures_of(root, where);
  // What is not used is not parsed a second time.
  for (const char* unused : {"images", "skins", "cameras", "extras", "extensions"}) root.erase(unused);
  if (!pictures)
    for (const char* unused : {"textures", "samplers", "animations"}) root.erase(unused);
  const std::string text = root.dump(-1, ' ', true, json::error_handler_t::replace);
  root = nullptr;

  Reach reach;
  std::error_code fault;
  if (!folder.empty()) reach.folder = fs::canonical(folder, fault);
  tinygltf::TinyGLTF parser;
  parser.SetStoreOriginalJSONForExtrasAndExtensions(pictures != nullptr);
  parser.SetFsCallbacks({&inside, &same_path, &read_buffer, &write_nothing, &reach});
  tinygltf::Model document;
  std::string errors, warnings;
  bool good = false;
  try {
    if (chunks
            .packed) {  // put together again, exact to the byte: tinygltf 2.7 checks its second chunk 8 bytes too late
      const std::size_t text_bytes = (text.size() + 3) / 4 * 4, binary_bytes = (chunks.binary.size() + 3) / 4 * 4;
      std::vector<std::uint8_t> packed{'g', 'l', 'T', 'F', 2, 0, 0, 0};
      packed.reserve(28 + text_bytes + binary_bytes);
      append_word(packed, 20 + text_bytes + (binary_bytes ? 8 + binary_bytes : 0));
      append_word(packed, text_bytes);
      append_word(packed, 0x4E4F534A);
      packed.insert(packed.end(), text.begin(), text.end());
      packed.resize(20 + text_bytes, ' ');
      if (binary_bytes) {
        append_word(packed, binary_bytes);
        append_word(packed, 0x004E4942);
        packed.insert(packed.end(), chunks.binary.begin(), chunks.binary.end());
        packed.resize(28 + text_bytes + binary_bytes, 0);
      }
      good = parser.LoadBinaryFromMemory(&document, &errors, &warnings, packed.data(),
                                         static_cast<unsigned>(packed.size()), reach.folder.string());
    } else {
      good = parser.LoadASCIIFromString(&document, &errors, &warnings, text.data(), static_cast<unsigned>(text.size()),
                                        reach.folder.string());
    }
  } catch (const Error&) {
    throw;
  } catch (const std::exception& exception) {
    errors = exception.what();
  }
  if (!good)
    fail(where, "is a broken model: " + (reach.refusal.empty() ? first_line(errors) : reach.refusal),
         "put its buffers beside it, or export it again");
  return document;
}

}  // namespace seascape
