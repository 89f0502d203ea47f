#include "pictures/drawing/exr_writer.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"

#include <fmt/format.h>
#include <tinyexr.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string_view>

namespace sunfleck {
namespace {

struct FreeMemory {
  void operator()(unsigned char* memory) const { std::free(memory); }
};

// Holds the plain arrays that tinyexr's header and image point to. tinyexr takes non-const pointers but changes nothing.
struct ExrArrays {
  std::vector<EXRChannelInfo> channels;
  std::vector<int> types;
  std::vector<unsigned char*> values;
  EXRAttribute comments{};

  explicit ExrArrays(const ExrImage& image) {
    // The format requires the channels in the order of their names.
    std::vector<const ExrChannel*> sorted;
    for (const ExrChannel& channel : image.channels) sorted.push_back(&channel);
    std::sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
    for (const ExrChannel* channel : sorted) add(*channel, static_cast<std::size_t>(image.width) * image.height);
    std::string_view("comments").copy(comments.name, sizeof(comments.name) - 1);
    std::string_view("string").copy(comments.type, sizeof(comments.type) - 1);
    comments.value = reinterpret_cast<unsigned char*>(const_cast<char*>(image.comments.data()));
    comments.size = static_cast<int>(image.comments.size());
  }

 private:
  void add(const ExrChannel& channel, std::size_t pixels) {
    EXRChannelInfo info{};
    EXPECT(channel.name.size(), <, sizeof(info.name));
    EXPECT(channel.name.size(), >, std::size_t{0});
    channel.name.copy(info.name, sizeof(info.name) - 1);
    channels.push_back(info);
    types.push_back(std::holds_alternative<std::vector<float>>(channel.values) ? TINYEXR_PIXELTYPE_FLOAT
                                                                               : TINYEXR_PIXELTYPE_UINT);
    std::visit(
        [&](const auto& of_channel) {
          EXPECT(of_channel.size(), ==, pixels);
          values.push_back(reinterpret_cast<unsigned char*>(const_cast<void*>(static_cast<const void*>(of_channel.data()))));
        },
        channel.values);
  }
};

}  // namespace

void write_exr(const ExrImage& image, const std::filesystem::path& file) {
  EXPECT(image.width, >, 0);
  EXPECT(image.height, >, 0);
  EXPECT(image.channels.size(), >, std::size_t{0});
  ExrArrays arrays(image);
  EXRHeader header;
  InitEXRHeader(&header);
  header.num_channels = static_cast<int>(arrays.channels.size());
  header.channels = arrays.channels.data();
  header.pixel_types = arrays.types.data();
  header.requested_pixel_types = arrays.types.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  header.num_custom_attributes = 1;
  header.custom_attributes = &arrays.comments;
  EXRImage pixels;
  InitEXRImage(&pixels);
  pixels.num_channels = header.num_channels;
  pixels.images = arrays.values.data();
  pixels.width = image.width;
  pixels.height = image.height;

  unsigned char* bytes = nullptr;
  const char* message = nullptr;
  const std::size_t size = SaveEXRImageToMemory(&pixels, &header, &bytes, &message);
  const std::unique_ptr<unsigned char, FreeMemory> owner(bytes);
  if (size == 0) {
    const std::string why = message != nullptr ? printable(message) : "out of memory";
    FreeEXRErrorMessage(message);
    throw_failure(fmt::format("{}: cannot encode {} x {} pixels as EXR", printable(file.string()), image.width, image.height),
                  why, "ask for a smaller picture");
  }
  write_file(file, {reinterpret_cast<const char*>(bytes), size});
}

}  // namespace sunfleck
