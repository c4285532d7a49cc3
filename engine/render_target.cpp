#include "engine/render_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "engine/error.h"

namespace seascape {

namespace {

VkRenderPass make_render_pass(Device& device, const TargetSpec& spec) {
  const auto samples = VkSampleCountFlagBits(spec.samples);
  std::vector<VkAttachmentDescription> attachments;
  auto add = [&](VkFormat format, VkSampleCountFlagBits count, VkAttachmentLoadOp load, VkAttachmentStoreOp store,
                 VkImageLayout layout) {
    VkAttachmentDescription a{};
    a.format = format;
    a.samples = count;
    a.loadOp = load;
    a.storeOp = store;
    a.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.initialLayout = a.finalLayout = layout;
    attachments.push_back(a);
    return VkAttachmentReference{std::uint32_t(attachments.size() - 1), layout};
  };
  const bool multi = spec.samples > 1;
  const VkImageLayout colour_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  // With several samples only the resolved picture is stored; the samples never leave the tile.
  VkAttachmentReference colours[2];
  const VkAttachmentLoadOp begin = spec.clear_colour ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  colours[0] = add(spec.colour, samples, begin, multi ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE,
                   colour_layout);
  VkAttachmentReference depth{}, resolve{};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = colours;
  if (spec.depth) {
    depth = add(device.facts().depth_format, samples, VK_ATTACHMENT_LOAD_OP_CLEAR,
                spec.keep_depth ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE,
                VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    subpass.pDepthStencilAttachment = &depth;
  }
  if (spec.second != VK_FORMAT_UNDEFINED) {
    assert(!multi);
    colours[1] = add(spec.second, samples, begin, VK_ATTACHMENT_STORE_OP_STORE, colour_layout);
    subpass.colorAttachmentCount = 2;
  }
  if (multi) {
    resolve = add(spec.colour, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE,
                  colour_layout);
    subpass.pResolveAttachments = &resolve;
  }
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
      fmt::format("pass colour {} {} cleared {} samples {} depth {} {} views {} {}", int(spec.colour), int(spec.second),
                  spec.clear_colour, spec.samples, spec.depth, spec.keep_depth, spec.per_eye ? 1 : spec.views,
                  spec.per_eye ? "per eye" : "multiview");
  return device.cached_render_pass(key, info);
}

}  // namespace

RenderTarget::RenderTarget(Device& device, std::string_view name, const TargetSpec& spec) : spec_(spec) {
  render_pass_ = make_render_pass(device, spec);
  ImageSpec image;
  image.width = spec.width;
  image.height = spec.height;
  image.layers = std::uint32_t(spec.views);
  image.format = spec.colour;
  image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  if (spec.per_eye && spec.samples > 1) {
    image.layers = 1;
    resolved_eye_ = Image(device, fmt::format("{} resolved eye", name), image);
    image.layers = std::uint32_t(spec.views);
    image.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  }
  colour_ = Image(device, fmt::format("{} colour", name), image);
  if (spec.second != VK_FORMAT_UNDEFINED) {
    image.format = spec.second;
    second_ = Image(device, fmt::format("{} second", name), image);
    image.format = spec.colour;
  }
  // Samples and depth live inside one pass; where eyes are drawn one after the other they share them.
  if (spec.per_eye) image.layers = 1;
  image.samples = samples();
  image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  image.transient = true;
  if (spec.samples > 1) multisampled_ = Image(device, fmt::format("{} samples", name), image);
  image.format = device.facts().depth_format;
  image.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  if (spec.keep_depth) {
    image.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    image.transient = false;
    image.layers = std::uint32_t(spec.views);
  }
  if (spec.depth) depth_ = Image(device, fmt::format("{} depth", name), image);

  const std::uint32_t passes = spec.per_eye ? std::uint32_t(spec.views) : 1u;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    auto view_of = [&](Image& i) {
      return spec.per_eye ? i.subview(0, 1, std::min(pass, i.spec().layers - 1), 1, false)
                          : i.subview(0, 1, 0, std::uint32_t(spec.views));
    };
    std::vector<VkImageView> views;
    if (spec.samples > 1)
      views.push_back(view_of(multisampled_));
    else
      views.push_back(view_of(colour_));
    if (spec.depth) views.push_back(view_of(depth_));
    if (second_) views.push_back(view_of(second_));
    if (spec.samples > 1) views.push_back(view_of(resolved_eye_ ? resolved_eye_ : colour_));
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = render_pass_;
    info.attachmentCount = std::uint32_t(views.size());
    info.pAttachments = views.data();
    info.width = spec.width;
    info.height = spec.height;
    info.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    check(vkCreateFramebuffer(device.handle(), &info, nullptr, &framebuffer), "vkCreateFramebuffer");
    framebuffers_.emplace_back(device, framebuffer, name);
  }
}

}  // namespace seascape
