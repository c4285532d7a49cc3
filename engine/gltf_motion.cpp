// Animations of a glTF document, and where they bring its nodes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/gltf_reader.h"
#include "engine/tinygltf_library.h"

namespace seascape {

std::vector<SolidAnimation> GltfReader::animations() const {
  constexpr std::size_t most_channels = 65536;
  std::vector<SolidAnimation> made;
  std::size_t channels = 0;
  for (std::size_t a = 0; a < document_.animations.size(); ++a) {
    const tinygltf::Animation& source = document_.animations[a];
    SolidAnimation animation;
    animation.name = source.name;
    for (const tinygltf::AnimationChannel& one : source.channels) {
      if (++channels > most_channels) fail(fmt::format("has more than {} animation channels", most_channels));
      const auto bad = [&](const std::string& what) { fail(fmt::format("animation {} {}", a, what)); };
      if (one.target_node < 0) continue;  // glTF 2.0, section 3.11: without a node it moves nothing
      if (static_cast<std::size_t>(one.target_node) >= document_.nodes.size())
        bad(fmt::format("moves node {}, which does not exist", one.target_node));
      if (one.target_path == "weights") bad("moves morph targets, which are not drawn");
      SolidChannel channel;
      channel.node = one.target_node;
      if (one.target_path == "translation")
        channel.path = SolidChannel::Path::translation;
      else if (one.target_path == "rotation")
        channel.path = SolidChannel::Path::rotation;
      else if (one.target_path == "scale")
        channel.path = SolidChannel::Path::scale;
      else
        continue;  // of an extension
      if (one.sampler < 0 || static_cast<std::size_t>(one.sampler) >= source.samplers.size())
        bad(fmt::format("names sampler {}, which does not exist", one.sampler));
      const tinygltf::AnimationSampler& sampler = source.samplers[static_cast<std::size_t>(one.sampler)];
      if (sampler.interpolation == "STEP")
        channel.interpolation = SolidChannel::Interpolation::step;
      else if (sampler.interpolation == "CUBICSPLINE")
        channel.interpolation = SolidChannel::Interpolation::cubic;
      channel.times_s = accessors_.floats(sampler.input, 1);
      for (std::size_t i = 0; i < channel.times_s.size(); ++i)
        if (!std::isfinite(channel.times_s[i]) || channel.times_s[i] < 0.0f ||
            (i > 0 && channel.times_s[i] < channel.times_s[i - 1]))
          bad("has times that do not rise");
      const bool turns = channel.path == SolidChannel::Path::rotation;
      const int parts = turns ? 4 : 3;
      const std::vector<float> values = accessors_.floats(sampler.output, parts);
      const std::size_t each = channel.interpolation == SolidChannel::Interpolation::cubic ? 3 : 1;
      if (values.size() != each * channel.times_s.size() * static_cast<std::size_t>(parts))
        bad(fmt::format("has {} times and {} values", channel.times_s.size(),
                        values.size() / static_cast<std::size_t>(parts)));
      for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(parts)) {
        const glm::vec4 value(values[i], values[i + 1], values[i + 2], turns ? values[i + 3] : 0.0f);
        for (int c = 0; c < 4; ++c)
          if (!std::isfinite(value[c])) bad("has a value that is not finite");
        channel.values.push_back(value);
      }
      animation.duration_s = std::max(animation.duration_s, double(channel.times_s.back()));
      animation.channels.push_back(std::move(channel));
    }
    made.push_back(std::move(animation));
  }
  return made;
}

namespace {

glm::dquat turn_of(const glm::vec4& value, const glm::dquat& otherwise) {
  const glm::dquat turn(value.w, value.x, value.y, value.z);
  const double length = glm::length(turn);
  return length > 1e-6 ? turn / length : otherwise;
}

// glTF 2.0, appendix C: held before the first key and after the last.
void move(SolidNode& node, const SolidChannel& channel, double time_s) {
  const auto& times = channel.times_s;
  const std::size_t after =
      static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), float(time_s)) - times.begin());
  const std::size_t from = after == 0 ? 0 : after - 1, to = std::min(after, times.size() - 1);
  const double span_s = double(times[to]) - double(times[from]);
  const double share = span_s > 0.0 ? std::clamp((time_s - double(times[from])) / span_s, 0.0, 1.0) : 0.0;
  const bool cubic = channel.interpolation == SolidChannel::Interpolation::cubic,
             turns = channel.path == SolidChannel::Path::rotation;
  const auto key = [&](std::size_t i, std::size_t part) {
    return glm::dvec4(channel.values[cubic ? 3 * i + part : i]);
  };
  glm::dvec4 value = key(from, 1);
  if (cubic) {
    const double t = share, t2 = t * t, t3 = t2 * t;
    value = (2.0 * t3 - 3.0 * t2 + 1.0) * key(from, 1) + span_s * (t3 - 2.0 * t2 + t) * key(from, 2) +
            (-2.0 * t3 + 3.0 * t2) * key(to, 1) + span_s * (t3 - t2) * key(to, 0);
  } else if (channel.interpolation == SolidChannel::Interpolation::linear && !turns) {
    value = glm::mix(key(from, 1), key(to, 1), share);
  }
  switch (channel.path) {
    case SolidChannel::Path::translation:
      node.translation = glm::dvec3(value);
      break;
    case SolidChannel::Path::scale:
      node.scale = glm::dvec3(value);
      break;
    case SolidChannel::Path::rotation:
      node.rotation = turn_of(glm::vec4(value), node.rotation);
      if (channel.interpolation == SolidChannel::Interpolation::linear)
        node.rotation = glm::slerp(node.rotation, turn_of(glm::vec4(key(to, 1)), node.rotation), share);
      break;
  }
}

}  // namespace

glm::dmat4 SolidNode::local() const {
  if (matrix) return *matrix;
  glm::dmat4 made = glm::mat4_cast(rotation);
  for (int c = 0; c < 3; ++c) made[c] *= scale[c];
  made[3] = glm::dvec4(translation, 1.0);
  return made;
}

const std::vector<glm::dmat4>& place_nodes(const SolidModel& model, const SolidAnimation* animation, double time_s,
                                           MovedNodes& room) {
  room.nodes.resize(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const SolidNode& node = model.nodes[i];
    SolidNode& bare = room.nodes[i];
    bare.translation = node.translation;
    bare.rotation = node.rotation;
    bare.scale = node.scale;
    bare.matrix = node.matrix;
  }
  if (animation != nullptr) {
    const double whole_s = animation->duration_s;
    const double at_s = whole_s > 0.0 ? time_s - whole_s * std::floor(time_s / whole_s) : 0.0;
    for (const SolidChannel& channel : animation->channels) {
      SolidNode& node = room.nodes[static_cast<std::size_t>(channel.node)];
      node.matrix.reset();
      move(node, channel, at_s);
    }
  }
  room.placed.assign(model.nodes.size(), glm::dmat4(1.0));
  for (const int index : model.order) {
    const std::size_t at = static_cast<std::size_t>(index);
    const int parent = model.nodes[at].parent;
    room.placed[at] =
        (parent >= 0 ? room.placed[static_cast<std::size_t>(parent)] : glm::dmat4(1.0)) * room.nodes[at].local();
  }
  return room.placed;
}

std::vector<glm::dmat4> placed_nodes(const SolidModel& model, const SolidAnimation* animation, double time_s) {
  MovedNodes room;
  place_nodes(model, animation, time_s, room);
  return std::move(room.placed);
}

}  // namespace seascape
