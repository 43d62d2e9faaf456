#include "vk/device_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vk/vulkan_error.h"

namespace dpe::viewer {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using vk::ChooseDevice;

std::vector<DeviceDescription> Devices() {
  return {{0, "llvmpipe (LLVM 15)", "CPU", "llvmpipe", "1.3.230", {}},
          {1, "Small GPU", "integrated GPU", "", "1.1.0", {}},
          {2,
           "Old GPU",
           "discrete GPU",
           "",
           "1.0.3",
           {"its Vulkan is 1.0.3, 1.1 is needed"}},
          {3, "Big GPU", "discrete GPU", "", "1.3.0", {}},
          {4, "Big GPU", "discrete GPU", "", "1.3.0", {}}};
}

std::string Refusal(const std::vector<DeviceDescription>& devices,
                    const std::string& wanted) {
  try {
    ChooseDevice(devices, wanted);
  } catch (const VulkanError& error) {
    return error.what();
  }
  return "";
}

TEST(DeviceChoiceTest, TheBestSuitableOneIsTaken) {
  std::vector<DeviceDescription> devices = Devices();
  EXPECT_EQ(ChooseDevice(devices, ""), 3);
  devices.resize(3);
  EXPECT_EQ(ChooseDevice(devices, ""), 1);
  devices.resize(1);
  EXPECT_EQ(ChooseDevice(devices, ""), 0);
}

TEST(DeviceChoiceTest, ByIndex) {
  EXPECT_EQ(ChooseDevice(Devices(), "0"), 0);
  EXPECT_EQ(ChooseDevice(Devices(), "4"), 4);
}

TEST(DeviceChoiceTest, ByPartOfTheName) {
  EXPECT_EQ(ChooseDevice(Devices(), "LLVM"), 0);
  EXPECT_EQ(ChooseDevice(Devices(), "small gpu"), 1);
  EXPECT_EQ(ChooseDevice(Devices(), "gpu"), 3);
}

TEST(DeviceChoiceTest, RefusalsSayWhatThereIsAndWhyNot) {
  const std::string refusal = Refusal(Devices(), "old");
  EXPECT_THAT(refusal, HasSubstr("\"old\""));
  EXPECT_THAT(refusal,
              HasSubstr("2: Old GPU (discrete GPU, Vulkan 1.0.3); not suitable: "
                        "its Vulkan is 1.0.3, 1.1 is needed"));
  EXPECT_THAT(refusal,
              HasSubstr("0: llvmpipe (LLVM 15) (CPU, Vulkan 1.3.230, llvmpipe)"));
  EXPECT_THAT(Refusal(Devices(), "5"), HasSubstr("\"5\""));
  EXPECT_THAT(Refusal(Devices(), "99999999999999999999"), HasSubstr("Found"));
}

TEST(DeviceChoiceTest, WithoutDevicesItSaysWhatToInstall) {
  EXPECT_THAT(Refusal({}, ""), HasSubstr("mesa-vulkan-drivers"));
  EXPECT_THAT(Refusal({}, ""), Not(HasSubstr("Found")));
}

// The machine that runs the tests has a device, if only a software one.
TEST(DeviceChoiceTest, DevicesAreListedInOrder) {
  const std::vector<DeviceDescription> devices = ListDevices();
  ASSERT_FALSE(devices.empty());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_FALSE(devices[i].kind.empty());
    EXPECT_THAT(devices[i].version, HasSubstr("1."));
  }
  EXPECT_NO_THROW(ChooseDevice(devices, ""));
}

}  // namespace
}  // namespace dpe::viewer
