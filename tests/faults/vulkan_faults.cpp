// A Vulkan layer that lets one call fail (VK_LAYER_PATH, VK_INSTANCE_LAYERS=VK_LAYER_SUNFLECK_faults).
//   SUNFLECK_FAULT_CALL="vkQueueSubmit 7 -4"   the seventh and all later calls of this function return VkResult -4
//   SUNFLECK_FAULT_LOG=/a/file                 the number of calls of each function, written at the end
// A failing call does nothing, except that vkWaitForFences waits: memory that a device still uses must not be freed, and a lost
// device uses none.

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

PFN_vkGetInstanceProcAddr next_instance_proc = nullptr;
PFN_vkGetDeviceProcAddr next_device_proc = nullptr;

struct Watched {
  const char* name;
  PFN_vkVoidFunction next;
  unsigned calls;
};

enum Number : std::size_t {
  allocate_memory,
  map_memory,
  bind_buffer_memory,
  create_buffer,
  create_buffer_view,
  create_fence,
  create_command_pool,
  allocate_command_buffers,
  begin_command_buffer,
  end_command_buffer,
  queue_submit,
  wait_for_fences,
  reset_fences,
  create_descriptor_set_layout,
  create_descriptor_pool,
  allocate_descriptor_sets,
  create_pipeline_layout,
  create_shader_module,
  create_compute_pipelines,
  create_device,
  count
};

std::array<Watched, Number::count> watched{{{"vkAllocateMemory", nullptr, 0},
                                            {"vkMapMemory", nullptr, 0},
                                            {"vkBindBufferMemory", nullptr, 0},
                                            {"vkCreateBuffer", nullptr, 0},
                                            {"vkCreateBufferView", nullptr, 0},
                                            {"vkCreateFence", nullptr, 0},
                                            {"vkCreateCommandPool", nullptr, 0},
                                            {"vkAllocateCommandBuffers", nullptr, 0},
                                            {"vkBeginCommandBuffer", nullptr, 0},
                                            {"vkEndCommandBuffer", nullptr, 0},
                                            {"vkQueueSubmit", nullptr, 0},
                                            {"vkWaitForFences", nullptr, 0},
                                            {"vkResetFences", nullptr, 0},
                                            {"vkCreateDescriptorSetLayout", nullptr, 0},
                                            {"vkCreateDescriptorPool", nullptr, 0},
                                            {"vkAllocateDescriptorSets", nullptr, 0},
                                            {"vkCreatePipelineLayout", nullptr, 0},
                                            {"vkCreateShaderModule", nullptr, 0},
                                            {"vkCreateComputePipelines", nullptr, 0},
                                            {"vkCreateDevice", nullptr, 0}}};

struct Fault {
  char name[64] = "";
  unsigned from = 0;
  int result = 0;
};

Fault asked_fault() {
  Fault fault;
  const char* text = std::getenv("SUNFLECK_FAULT_CALL");
  if (text == nullptr || std::sscanf(text, "%63s %u %d", fault.name, &fault.from, &fault.result) != 3) fault.name[0] = '\0';
  return fault;
}

bool fails(Number number) {
  static const Fault fault = asked_fault();
  Watched& one = watched[number];
  ++one.calls;
  return std::strcmp(one.name, fault.name) == 0 && one.calls >= fault.from;
}

VkResult asked_result() {
  return static_cast<VkResult>(asked_fault().result);
}

struct LogAtEnd {
  ~LogAtEnd() {
    const char* file = std::getenv("SUNFLECK_FAULT_LOG");
    std::FILE* log = file != nullptr ? std::fopen(file, "w") : nullptr;
    if (log == nullptr) return;
    for (const Watched& one : watched) std::fprintf(log, "%s %u\n", one.name, one.calls);
    std::fclose(log);
  }
} log_at_end;

template <Number number, class Function>
struct Call;
template <Number number, class... Arguments>
struct Call<number, VkResult(VKAPI_PTR*)(Arguments...)> {
  static VKAPI_ATTR VkResult VKAPI_CALL run(Arguments... arguments) {
    const auto next = reinterpret_cast<VkResult(VKAPI_PTR*)(Arguments...)>(watched[number].next);
    const bool failing = fails(number);
    if (failing && number != wait_for_fences) return asked_result();
    const VkResult result = next(arguments...);
    return failing ? asked_result() : result;
  }
};

template <Number number, class Function>
PFN_vkVoidFunction call() {
  return reinterpret_cast<PFN_vkVoidFunction>(&Call<number, Function>::run);
}

PFN_vkVoidFunction replacement(std::size_t number) {
  switch (number) {
    case allocate_memory:
      return call<allocate_memory, PFN_vkAllocateMemory>();
    case map_memory:
      return call<map_memory, PFN_vkMapMemory>();
    case bind_buffer_memory:
      return call<bind_buffer_memory, PFN_vkBindBufferMemory>();
    case create_buffer:
      return call<create_buffer, PFN_vkCreateBuffer>();
    case create_buffer_view:
      return call<create_buffer_view, PFN_vkCreateBufferView>();
    case create_fence:
      return call<create_fence, PFN_vkCreateFence>();
    case create_command_pool:
      return call<create_command_pool, PFN_vkCreateCommandPool>();
    case allocate_command_buffers:
      return call<allocate_command_buffers, PFN_vkAllocateCommandBuffers>();
    case begin_command_buffer:
      return call<begin_command_buffer, PFN_vkBeginCommandBuffer>();
    case end_command_buffer:
      return call<end_command_buffer, PFN_vkEndCommandBuffer>();
    case queue_submit:
      return call<queue_submit, PFN_vkQueueSubmit>();
    case wait_for_fences:
      return call<wait_for_fences, PFN_vkWaitForFences>();
    case reset_fences:
      return call<reset_fences, PFN_vkResetFences>();
    case create_descriptor_set_layout:
      return call<create_descriptor_set_layout, PFN_vkCreateDescriptorSetLayout>();
    case create_descriptor_pool:
      return call<create_descriptor_pool, PFN_vkCreateDescriptorPool>();
    case allocate_descriptor_sets:
      return call<allocate_descriptor_sets, PFN_vkAllocateDescriptorSets>();
    case create_pipeline_layout:
      return call<create_pipeline_layout, PFN_vkCreatePipelineLayout>();
    case create_shader_module:
      return call<create_shader_module, PFN_vkCreateShaderModule>();
    case create_compute_pipelines:
      return call<create_compute_pipelines, PFN_vkCreateComputePipelines>();
    default:
      return nullptr;
  }
}

// Returns the link to the layer that follows, null if the loader gave none; advances it so that the next layer finds its own.
template <class Link, class Info>
auto* take_link(const Info* info, VkStructureType type) {
  auto* link = static_cast<Link*>(const_cast<void*>(info->pNext));
  while (link != nullptr && (link->sType != type || link->function != VK_LAYER_LINK_INFO)) {
    link = static_cast<Link*>(const_cast<void*>(link->pNext));
  }
  auto* found = link == nullptr ? nullptr : link->u.pLayerInfo;
  if (found != nullptr) link->u.pLayerInfo = found->pNext;
  return found;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
  const auto* link = take_link<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  next_instance_proc = link->pfnNextGetInstanceProcAddr;
  const auto next = reinterpret_cast<PFN_vkCreateInstance>(next_instance_proc(nullptr, "vkCreateInstance"));
  const VkResult result = next(info, allocator, instance);
  if (result == VK_SUCCESS) watched[create_device].next = next_instance_proc(*instance, "vkCreateDevice");
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device_of(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                                const VkAllocationCallbacks* allocator, VkDevice* device) {
  const auto* link = take_link<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  next_device_proc = link->pfnNextGetDeviceProcAddr;
  if (fails(create_device)) return asked_result();
  const auto next = reinterpret_cast<PFN_vkCreateDevice>(watched[create_device].next);
  const VkResult result = next(physical, info, allocator, device);
  if (result != VK_SUCCESS) return result;
  for (std::size_t number = 0; number < create_device; ++number) {
    watched[number].next = next_device_proc(*device, watched[number].name);
  }
  return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_proc(VkDevice device, const char* name) {
  for (std::size_t number = 0; number < create_device; ++number) {
    if (std::strcmp(watched[number].name, name) == 0) return replacement(number);
  }
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&device_proc);
  return next_device_proc(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_proc(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkCreateInstance") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&create_instance);
  if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&create_device_of);
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&instance_proc);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&device_proc);
  for (std::size_t number = 0; number < create_device; ++number) {
    if (std::strcmp(watched[number].name, name) == 0) return replacement(number);
  }
  return instance != nullptr && next_instance_proc != nullptr ? next_instance_proc(instance, name) : nullptr;
}

}  // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
  version->loaderLayerInterfaceVersion = 2;
  version->pfnGetInstanceProcAddr = instance_proc;
  version->pfnGetDeviceProcAddr = device_proc;
  version->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
