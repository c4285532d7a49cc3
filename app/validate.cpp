#include "app/validate.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "app/camera_path.h"
#include "app/commands.h"
#include "app/input_script_file.h"
#include "app/located_json.h"
#include "app/scene.h"
#include "app/sea_remarks.h"
#include "engine/files.h"
#include "engine/image_file.h"
#include "engine/solid_model.h"
#include "engine/text.h"

namespace seascape {

namespace {

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string picture_summary(const char* kind, int width, int height) {
  return std::string(kind) + " of " + std::to_string(width) + "x" + std::to_string(height) + " pixels";
}

// "3 poses, 12 actions and 1 state".
std::string what_happens(const InputScript& script) {
  std::array<std::size_t, 3> counts{};
  for (const InputEvent& event : script.events) ++counts[event.what.index()];
  return counted(counts[0], "pose") + ", " + counted(counts[1], "action") + " and " + counted(counts[2], "state");
}

std::string json_summary(const std::string& text, const std::string& where, Faults& faults,
                         std::vector<std::string>& remarks) {
  const LocatedJson json = parse_located_json(text, where);
  if (json.member("keys") != nullptr) {
    const CameraPath path = parse_camera_path(text, where, faults);
    return "a path of " + counted(path.keys.size(), "key") + " and " + text_from(path.duration_s()) + " s" +
           (path.actions ? ", with " + what_happens(*path.actions) : "");
  }
  if (json.member("events") != nullptr && json.member("effects") == nullptr) {
    const InputScript script = parse_input_script(text, where, faults);
    return "an input script of " + text_from(script.end_s()) + " s with " + what_happens(script);
  }
  const Scene scene = parse_scene(text, where, "auto", faults);
  if (faults.list().empty()) remarks = remarks_of(scene);  // which takes a scene without faults
  return "a scene with " + counted(scene.effects.size(), "effect") +
         (scene.inputs.empty() ? "" : " and " + counted(scene.inputs.size(), "input")) +
         (scene.objects.empty() ? "" : ", with " + counted(scene.objects.things.size(), "object"));
}

std::string model_summary(const std::filesystem::path& file) {
  const SolidModel model = load_solid_model(file);
  std::string text = "a model of " + counted(model.triangles(), "triangle") + ", " +
                     counted(model.materials.size(), "material") + " and " + counted(model.images.size(), "picture");
  if (!model.animations.empty()) text += ", with " + counted(model.animations.size(), "animation");
  return text;
}

}  // namespace

FileVerdict validate_file(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  FileVerdict verdict;
  Faults faults(true);
  faults.attempt([&] {
    if (kind == ".json") {
      verdict.summary = json_summary(read_text(file, largest_json_bytes), file.string(), faults, verdict.remarks);
    } else if (kind == ".gltf" || kind == ".glb") {
      verdict.summary = model_summary(file);
    } else if (kind == ".png") {
      const Image8 image = read_png(file);
      verdict.summary = picture_summary("a PNG image", image.width, image.height);
    } else if (kind == ".exr") {
      const ImageF image = read_exr(file);
      verdict.summary = picture_summary("an EXR image", image.width, image.height);
    } else {
      throw Error(file.string(), "the kind " + in_quotes(kind) + " is not known",
                  "give .json scenes, paths and input scripts, .gltf or .glb models, .png or .exr images");
    }
  });
  verdict.faults = faults.list();
  return verdict;
}

int run_validate(const Arguments& arguments) {
  int exit_code = 0;
  for (const std::string& file : arguments.files) {
    const FileVerdict verdict = validate_file(file);
    for (const std::string& remark : verdict.remarks) std::fprintf(stderr, "seascape: warning: %s\n", remark.c_str());
    for (const Error& fault : verdict.faults) std::fprintf(stderr, "seascape: %s\n", fault.what());
    if (verdict.faults.empty()) std::printf("%s: %s\n", file.c_str(), verdict.summary.c_str());
    if (!verdict.faults.empty()) exit_code = 1;
  }
  return exit_code;
}

}  // namespace seascape
