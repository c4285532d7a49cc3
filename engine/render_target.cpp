#include "engine/render_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "engine/error.h"

namespace seascape {

namespace {

VkRenderPass make_render_pass(Device& device, const TargetSpec& spec, const std::vector<TargetAttachment>& rows) {
  using Part = TargetAttachment::Part;
  std::vector<VkAttachmentDescription> attachments;
  VkAttachmentReference colours[2], depth{}, resolve{}, depth_resolve{};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.pColorAttachments = colours;
  for (const TargetAttachment& row : rows) {
    VkAttachmentDescription a{};
    a.format = row.format;
    a.samples = VkSampleCountFlagBits(row.samples);
    a.loadOp = row.load;
    a.storeOp = row.store;
    const bool stencil = spec.stencil && row.part == Part::depth;
    a.stencilLoadOp = stencil ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a.stencilStoreOp = stencil ? row.store : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.initialLayout = a.finalLayout = row.part == Part::depth || row.part == Part::resolved_depth
                                          ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                          : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    const VkAttachmentReference reference{std::uint32_t(attachments.size()), a.finalLayout};
    attachments.push_back(a);
    switch (row.part) {
      case Part::colour:
      case Part::second:
        colours[subpass.colorAttachmentCount++] = reference;
        break;
      case Part::depth:
        depth = reference;
        subpass.pDepthStencilAttachment = &depth;
        break;
      case Part::resolved:
        resolve = reference;
        subpass.pResolveAttachments = &resolve;
        break;
      case Part::resolved_depth:
        depth_resolve = reference;
        break;
    }
  }
  const bool resolves_depth = !rows.empty() && rows.back().part == Part::resolved_depth;
  const std::uint32_t view_mask = (1u << spec.views) - 1u;
  VkRenderPassMultiviewCreateInfo multiview{VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO};
  multiview.subpassCount = 1;
  multiview.pViewMasks = &view_mask;
  multiview.correlationMaskCount = 1;
  multiview.pCorrelationMasks = &view_mask;
  VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  if (!spec.per_eye) info.pNext = &multiview;
  info.attachmentCount = std::uint32_t(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  const std::string key =
      fmt::format("pass colour {} {} cleared {} samples {} depth {} {} {} {} views {} {}", int(spec.colour),
                  int(spec.second), spec.clear_colour, spec.samples, spec.depth, spec.stencil, spec.keep_depth,
                  spec.show_depth, spec.per_eye ? 1 : spec.views, spec.per_eye ? "per eye" : "multiview");
  return resolves_depth ? device.cached_render_pass(key, info, depth_resolve) : device.cached_render_pass(key, info);
}

}  // namespace

// With several samples only the resolved picture is stored: samples, and depth that nobody reads, never leave the tile.
std::vector<TargetAttachment> attachments_of(const TargetSpec& spec, const DeviceFacts& facts) {
  using Part = TargetAttachment::Part;
  constexpr auto stored = VK_ATTACHMENT_STORE_OP_STORE, dropped = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  const bool multi = spec.samples > 1;
  const VkAttachmentLoadOp begin = spec.clear_colour ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  std::vector<TargetAttachment> rows;
  if (spec.colour != VK_FORMAT_UNDEFINED)
    rows.push_back({Part::colour, spec.colour, spec.samples, begin, multi ? dropped : stored});
  if (spec.depth)
    rows.push_back({Part::depth, spec.stencil ? facts.depth_stencil_format : facts.depth_format, spec.samples,
                    VK_ATTACHMENT_LOAD_OP_CLEAR, spec.keep_depth || (spec.show_depth && !multi) ? stored : dropped});
  if (spec.second != VK_FORMAT_UNDEFINED) {
    assert(!multi);
    rows.push_back({Part::second, spec.second, spec.samples, begin, stored});
  }
  if (multi) rows.push_back({Part::resolved, spec.colour, 1, VK_ATTACHMENT_LOAD_OP_DONT_CARE, stored});
  if (multi && spec.depth && spec.show_depth)
    rows.push_back({Part::resolved_depth, facts.depth_format, 1, VK_ATTACHMENT_LOAD_OP_DONT_CARE, stored});
  return rows;
}

RenderTarget::RenderTarget(Device& device, std::string_view name, const TargetSpec& spec, const LentImages* lent)
    : spec_(spec), image_size_{spec.width, spec.height} {
  if (!spec_.depth || (spec_.samples > 1 ? !device.facts().depth_resolve : spec_.stencil)) spec_.show_depth = false;
  attachments_ = attachments_of(spec_, device.facts());
  render_pass_ = make_render_pass(device, spec_, attachments_);
  make_images(device, name, lent);
  make_framebuffers(device, name);
}

void RenderTarget::make_images(Device& device, std::string_view name, const LentImages* lent) {
  ImageSpec image;
  image.width = spec_.width;
  image.height = spec_.height;
  image.layers = std::uint32_t(spec_.views);
  image.format = spec_.colour;
  image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  const auto borrow = [&](std::vector<Image>& to, const std::vector<VkImage>& handles, ImageSpec theirs) {
    theirs.width = lent->width;
    theirs.height = lent->height;
    for (VkImage handle : handles) to.emplace_back(device, fmt::format("{} lent", name), handle, theirs);
  };
  if (spec_.per_eye && spec_.samples > 1) {
    image.layers = 1;
    resolved_eye_ = Image(device, fmt::format("{} resolved eye", name), image);
    image.layers = std::uint32_t(spec_.views);
    image.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  }
  if (has_colour() && lent && !lent->colours.empty())
    borrow(colours_, lent->colours, image);
  else if (has_colour())
    colours_.emplace_back(device, fmt::format("{} colour", name), image);
  if (spec_.second != VK_FORMAT_UNDEFINED) {
    image.format = spec_.second;
    second_ = Image(device, fmt::format("{} second", name), image);
    image.format = spec_.colour;
  }
  // Samples and depth live inside one pass; where eyes are drawn one after the other they share them.
  if (spec_.per_eye) image.layers = 1;
  image.samples = samples();
  image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  image.transient = true;
  if (spec_.samples > 1) multisampled_ = Image(device, fmt::format("{} samples", name), image);
  if (!spec_.depth) return;
  image.format = device.facts().depth_format;
  image.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  if (spec_.keep_depth || (spec_.show_depth && spec_.samples == 1)) image.layers = std::uint32_t(spec_.views);
  if (spec_.show_depth) {
    ImageSpec shown = image;
    shown.layers = std::uint32_t(spec_.views);
    shown.samples = VK_SAMPLE_COUNT_1_BIT;
    shown.transient = false;
    shown.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (lent && !lent->depths.empty()) {
      borrow(shown_depths_, lent->depths, shown);
    } else {
      shown_depths_.emplace_back(device, fmt::format("{} shown depth", name), shown);
    }
    if (spec_.samples == 1) return;
  }
  if (spec_.stencil) image.format = device.facts().depth_stencil_format;
  if (spec_.keep_depth) {
    image.usage |= VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    image.transient = false;
  }
  depth_ = Image(device, fmt::format("{} depth", name), image);
  if (spec_.stencil && spec_.keep_depth) stencil_view_ = depth_.stencil_view();
}

void RenderTarget::make_framebuffers(Device& device, std::string_view name) {
  const auto make = [&](Image* colour, Image* shown_depth, std::size_t pass) {
    auto view_of = [&](Image& i) {
      return spec_.per_eye ? i.subview(0, 1, std::min(std::uint32_t(pass), i.spec().layers - 1), 1, false)
                           : i.subview(0, 1, 0, std::uint32_t(spec_.views));
    };
    std::vector<VkImageView> views;
    if (colour != nullptr) views.push_back(view_of(spec_.samples > 1 ? multisampled_ : *colour));
    if (spec_.depth) views.push_back(view_of(depth_ ? depth_ : *shown_depth));
    if (second_) views.push_back(view_of(second_));
    if (spec_.samples > 1) views.push_back(view_of(resolved_eye_ ? resolved_eye_ : *colour));
    if (spec_.samples > 1 && shown_depth) views.push_back(view_of(*shown_depth));
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = render_pass_;
    info.attachmentCount = std::uint32_t(views.size());
    info.pAttachments = views.data();
    info.width = image_size_.width;
    info.height = image_size_.height;
    info.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    check(vkCreateFramebuffer(device.handle(), &info, nullptr, &framebuffer), "vkCreateFramebuffer");
    framebuffers_.emplace_back(device, framebuffer, name);
  };
  for (Image& colour : colours_)
    for (std::size_t depth = 0; depth < depth_count(); ++depth)
      for (std::size_t pass = 0; pass < passes(); ++pass)
        make(&colour, shown_depths_.empty() ? nullptr : &shown_depths_[depth], pass);
  if (!has_colour())
    for (std::size_t depth = 0; depth < depth_count(); ++depth)
      for (std::size_t pass = 0; pass < passes(); ++pass)
        make(nullptr, shown_depths_.empty() ? nullptr : &shown_depths_[depth], pass);
}

void RenderTarget::choose(std::size_t colour, std::size_t depth) {
  chosen_colour_ = colours_.size() > 1 ? colour : 0;
  chosen_depth_ = shown_depths_.size() > 1 ? depth : 0;
  assert(chosen_colour_ < std::max<std::size_t>(1, colours_.size()) && chosen_depth_ < depth_count());
  // Who lent them had them meanwhile.
  if (!colours_.empty()) colours_[chosen_colour_].state() = {};
  if (!shown_depths_.empty()) shown_depths_[chosen_depth_].state() = {};
}

static std::uint64_t bytes_of(const TargetSpec& spec, const TargetAttachment& row) {
  return std::uint64_t(spec.width) * spec.height * std::uint64_t(spec.views) * std::uint64_t(row.samples) *
         bytes_per_texel(row.format);
}

std::uint64_t RenderTarget::loaded_bytes() const {
  std::uint64_t bytes = 0;
  for (const TargetAttachment& row : attachments_)
    if (row.load == VK_ATTACHMENT_LOAD_OP_LOAD) bytes += bytes_of(spec_, row);
  return bytes;
}

std::uint64_t RenderTarget::stored_bytes() const {
  std::uint64_t bytes = 0;
  for (const TargetAttachment& row : attachments_)
    if (row.store == VK_ATTACHMENT_STORE_OP_STORE) bytes += bytes_of(spec_, row);
  return bytes;
}

void RenderTarget::set_area(std::uint32_t width, std::uint32_t height) {
  assert(width <= image_size_.width && height <= image_size_.height);
  spec_.width = width;
  spec_.height = height;
}

}  // namespace seascape
