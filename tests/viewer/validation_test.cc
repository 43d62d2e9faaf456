// That the validation layer is heard, so that its silence in other tests means
// something.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/offscreen_renderer.h"
#include "support/sanitizers.h"
#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/instance.h"
#include "vk/vulkan_error.h"

namespace dpe::viewer {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

DeviceOptions Validated() {
  DeviceOptions options;
  options.validation = true;
  options.log = std::make_shared<ValidationLog>();
  return options;
}

TEST(ValidationTest, AnErrorIsHeard) {
  const DeviceOptions options = Validated();
  const vk::Instance instance(options, {});
  const vk::Device device(instance.get(), VK_NULL_HANDLE, {});
  EXPECT_THAT(options.log->messages(), IsEmpty());
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = 0;  // not allowed
  info.usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  if (vkCreateBuffer(device.get(), &info, nullptr, &buffer) == VK_SUCCESS) {
    vkDestroyBuffer(device.get(), buffer, nullptr);
  }
  EXPECT_THAT(options.log->messages(),
              Contains(HasSubstr("VUID-VkBufferCreateInfo-size-00912")));
}

TEST(ValidationTest, WhatIsLeftOverIsHeard) {
  const DeviceOptions options = Validated();
  const vk::Instance instance(options, {});
  VkSemaphore semaphore = VK_NULL_HANDLE;
  {
    const vk::Device device(instance.get(), VK_NULL_HANDLE, {});
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    const test::LeakOnPurpose unheard;
    ASSERT_EQ(vkCreateSemaphore(device.get(), &info, nullptr, &semaphore), VK_SUCCESS);
    EXPECT_THAT(options.log->messages(), IsEmpty());
  }
  EXPECT_THAT(options.log->messages(), Contains(HasSubstr("has not been destroyed")));
}

TEST(ValidationTest, AnErrorInCommandsIsHeard) {
  const DeviceOptions options = Validated();
  const vk::Instance instance(options, {});
  const vk::Device device(instance.get(), VK_NULL_HANDLE, {});
  const vk::Buffer buffer(device, 64, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, vk::kShared);
  // Copying into a buffer that was not made to be copied into.
  device.Run([&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, 32, 32};
    vkCmdCopyBuffer(commands, buffer.get(), buffer.get(), 1, &region);
  });
  EXPECT_THAT(options.log->messages(), Contains(HasSubstr("VUID-vkCmdCopyBuffer")));
}

TEST(ValidationTest, AMissingBarrierIsHeard) {
  const DeviceOptions options = Validated();
  const vk::Instance instance(options, {});
  const vk::Device device(instance.get(), VK_NULL_HANDLE, {});
  const VkBufferUsageFlags both =
      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  const vk::Buffer a(device, 64, both, vk::kShared);
  const vk::Buffer b(device, 64, both, vk::kShared);
  device.Run([&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, 0, 64};
    vkCmdCopyBuffer(commands, a.get(), b.get(), 1, &region);
    vkCmdCopyBuffer(commands, b.get(), a.get(), 1, &region);
  });
  EXPECT_THAT(options.log->messages(), Contains(HasSubstr("SYNC-HAZARD")));
}

TEST(ValidationTest, WithoutItNothingIsCollected) {
  DeviceOptions options = Validated();
  options.validation = false;
  {
    const vk::Instance instance(options, {});
    const vk::Device device(instance.get(), VK_NULL_HANDLE, {});
    device.WaitIdle();
  }
  EXPECT_TRUE(options.log->empty());
}

TEST(ValidationTest, UnknownDevicesAreRefused) {
  DeviceOptions options = Validated();
  options.device = "a device that nobody has";
  try {
    const OffscreenRenderer renderer(options, 8, 8);
    FAIL() << "it was accepted";
  } catch (const VulkanError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a device that nobody has"));
    EXPECT_THAT(error.what(), HasSubstr(Describe(ListDevices().at(0))));
  }
  EXPECT_THAT(options.log->messages(), IsEmpty());
}

}  // namespace
}  // namespace dpe::viewer
