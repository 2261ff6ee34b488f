// SPDX-License-Identifier: Apache-2.0
// The time that any Vulkan compute program needs: prints the seconds from the start of the process to the end of a
// nearly empty dispatch, on the best device or the one named.
#include <cstdio>

#include "format/base/run_tool.h"
#include "format/os/process_time.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "runtime/session/report.h"
#include "shaders/nothing.spv.h"

namespace pointrt {

namespace {

int run(const char* device_name) {
    secondsSinceStart();
    Device device = createDevice({device_name});
    Buffer result = createBuffer(device, "result", 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    Program program = createProgram(device, "nothing", nothing_spv);
    VkDescriptorPool pool = createDescriptorPool(device, 1);
    const VkDescriptorSet set = createDescriptorSet(device, pool, program, {{gpu::Binding{0}, &result}});
    const VkCommandBuffer commands = beginCommands(device);
    recordDispatch(commands, program, set, {}, {1, 1, 1});
    submitAndWait(device, commands);
    std::printf("%.4f\n", secondsSinceStart());
    destroyDescriptorPool(device, pool);
    destroyProgram(device, program);
    destroyBuffer(device, result);
    destroyDevice(device);
    return 0;
}

} // namespace

} // namespace pointrt

int main(int argc, char** argv) {
    return pointrt::runTool("empty_compute", [&] { return pointrt::run(argc > 1 ? argv[1] : ""); });
}
