// Tests every reader of users' files on files that claim more than they contain, point elsewhere or are not regular files.

#include "base/file.h"
#include "base/packed_array.h"
#include "files/formats/caribu/caribu_reader.h"
#include "files/formats/caribu/light_reader.h"
#include "files/formats/measured/measured_reader.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/formats/weather/weather_reader.h"
#include "files/results/stores/result_store.h"
#include "files/results/stores/step_store.h"
#include "support/caribu_files.h"
#include "support/mesh_files.h"
#include "support/scene_text.h"
#include "support/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <functional>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

struct Reader {
  const char* name;
  std::string good;
  std::function<void(const fs::path&)> read;
};

void read_any_mesh(const fs::path& file) {
  static_cast<void>(read_mesh(file, {.optics = "leaf", .up = std::nullopt}));
}

std::vector<Reader> readers_of_text() {
  return {
      {"scene.toml", bare_scene, [](const fs::path& file) { static_cast<void>(read_scene(file)); }},
      {"a.obj", obj_square(), read_any_mesh},
      {"a.can", can_square(), read_any_mesh},
      {"a.stl", stl_text_square(), read_any_mesh},
      {"a.ply", ply_text_square(), read_any_mesh},
      {"a.dae", dae_square(), read_any_mesh},
      {"a.opf", opf_square(), read_any_mesh},
      {"a.gltf", R"({"asset":{"version":"2.0"}})", read_any_mesh},
      {"a.opt", grey_opt, [](const fs::path& file) { static_cast<void>(read_opt(file)); }},
      {"a.8", filter_domain, [](const fs::path& file) { static_cast<void>(read_domain(file)); }},
      {"a.light", "1 0 0 -1\n", [](const fs::path& file) { static_cast<void>(read_lights(file)); }},
      {"a.csv", station_csv, [](const fs::path& file) { static_cast<void>(read_weather(file)); }},
      {"field.csv", "height_m,sunfleck_ratio\n0,0.5\n", [](const fs::path& file) { static_cast<void>(read_measured(file)); }}};
}

std::vector<Reader> all_readers() {
  std::vector<Reader> readers = readers_of_text();
  readers.push_back({"a.glb", "", read_any_mesh});
  readers.push_back({"a.can.gz", "", read_any_mesh});
  readers.push_back({"a.epw", "", [](const fs::path& file) { static_cast<void>(read_weather(file)); }});
  readers.push_back({"pictures.cbor", "", [](const fs::path& file) { static_cast<void>(read_result_store(file)); }});
  return readers;
}

void expect_refusal(const std::function<void()>& work, std::string_view words) {
  const auto message = message_of(work);
  ASSERT_TRUE(message) << "not refused: " << words;
  EXPECT_NE(message->find(words), message->npos) << *message << "\ndoes not say: " << words;
  expect_three_parts(*message);
}

// Opening a FIFO without a writer would hang.
TEST(HostileFiles, WhatIsNoFileIsRefusedByEveryReader) {
  const TempFolder folder;
  for (const char* kind : {"folder", "pipe", "device", "loop"}) fs::create_directory(folder / kind);
  for (const Reader& reader : all_readers()) {
    SCOPED_TRACE(reader.name);
    fs::create_directory(folder.path() / "folder" / reader.name);
    ASSERT_EQ(::mkfifo((folder.path() / "pipe" / reader.name).c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder.path() / "device" / reader.name);
    fs::create_symlink(reader.name, folder.path() / "loop" / reader.name);
    expect_refusal([&] { reader.read(folder / reader.name); }, "no such file");
    expect_refusal([&] { reader.read(folder.path() / "folder" / reader.name); }, "directory");
    expect_refusal([&] { reader.read(folder.path() / "pipe" / reader.name); }, "not a regular file");
    expect_refusal([&] { reader.read(folder.path() / "device" / reader.name); }, "not a regular file");
    expect_refusal([&] { reader.read(folder.path() / "loop" / reader.name); }, "ymbolic links");
    expect_refusal([&] { reader.read(folder.write(reader.name, "")); }, "");
  }
}

// A file with a hole of 100 TB takes no space on the disk; no memory may be requested for it.
TEST(HostileFiles, HugeFilesAreRefusedBeforeTheyAreRead) {
  const TempFolder folder;
  for (const Reader& reader : all_readers()) {
    SCOPED_TRACE(reader.name);
    const fs::path file = folder.write(reader.name, reader.good);
    std::error_code code;
    fs::resize_file(file, std::uintmax_t{1} << 40U, code);
    if (code) GTEST_SKIP() << "this disk cannot hold such a file: " << code.message();
    expect_refusal([&] { reader.read(file); }, "");
  }
}

// Windows line ends and a byte order mark change nothing.
TEST(HostileFiles, MarksAndLineEndsOfOtherSystems) {
  const TempFolder folder;
  for (const Reader& reader : readers_of_text()) {
    if (reader.name == std::string_view("a.gltf")) continue;
    SCOPED_TRACE(reader.name);
    std::string windows = "\xef\xbb\xbf";
    for (const char c : reader.good) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_NO_THROW(reader.read(folder.write(reader.name, reader.good)));
    EXPECT_NO_THROW(reader.read(folder.write(reader.name, windows)));
  }
  const Mesh mesh =
      read_mesh(folder.write("first.obj", "\xef\xbb\xbfv 5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {.optics = "leaf"});
  EXPECT_EQ(mesh.vertices.at(0).x, 5.0);
}

TEST(HostileFiles, ZeroBytesAndUtf16AreNoText) {
  const TempFolder folder;
  for (const Reader& reader : readers_of_text()) {
    SCOPED_TRACE(reader.name);
    std::string wide = "\xff\xfe";
    for (const char c : reader.good) wide += std::string{c, '\0'};
    const std::string zeros = reader.good.substr(0, reader.good.size() / 2) + std::string(3, '\0') + reader.good;
    expect_refusal([&] { reader.read(folder.write(reader.name, zeros)); }, "");
    const bool is_xml = reader.good.starts_with('<');  // XML says in which encoding it is
    if (is_xml)
      EXPECT_NO_THROW(reader.read(folder.write(reader.name, wide)));
    else
      expect_refusal([&] { reader.read(folder.write(reader.name, wide)); }, "");
  }
}

TEST(HostileFiles, SwappedBytesAreNamed) {
  const TempFolder folder;
  const auto turned = [](std::string bytes, std::initializer_list<std::size_t> words) {
    for (const std::size_t at : words)
      std::reverse(bytes.begin() + static_cast<long>(at), bytes.begin() + static_cast<long>(at) + 4);
    return bytes;
  };
  const std::string good = glb(gltf_document(), gltf_binary());
  const std::string stl = "_" + stl_binary_square().substr(1);
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"a.glb", turned(good, {4, 8, 12, 16})},
                                    {"b.glb", turned(good, {0, 4, 8, 12, 16})},
                                    {"a.stl", turned(stl, {80})}})
    expect_refusal([&, &name = name, &bytes = bytes] { read_any_mesh(folder.write(name, bytes)); },
                   "its numbers are big-endian");
}

TEST(HostileFiles, MeshesPromiseNoMoreThanTheyHold) {
  const TempFolder folder;
  const auto refused = [&](const char* name, const std::string& bytes, std::string_view words) {
    expect_refusal([&] { read_any_mesh(folder.write(name, bytes)); }, words);
  };
  std::string ply = "ply\nformat binary_little_endian 1.0\n";
  for (int i = 0; i < 500; ++i) ply += "element vertex 200000\nproperty float x\nproperty float y\nproperty float z\n";
  refused("a.ply", ply + "end_header\n" + std::string(2'400'000, 'a'), "bytes follow");
  refused("a.can.gz", gzip(std::string(300'000'000, ' ')), "holds more than");
  nlohmann::json document = gltf_document();
  document["accessors"][0]["count"] = 18446744073709551615U;
  refused("a.glb", glb(document, gltf_binary()), "end beyond bufferView");
  document = gltf_document();
  document["accessors"][0]["sparse"] = {
      {"count", 4000000000U}, {"indices", {{"bufferView", 1}, {"componentType", 5125}}}, {"values", {{"bufferView", 1}}}};
  refused("a.glb", glb(document, gltf_binary()), "sparse");
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "{\"a\":";
  refused("a.gltf", deep, "deep");
  refused("a.gltf", std::string(1'000'000, '['), "deep");
}

TEST(HostileFiles, ChainsOfNodesMayBeLong) {
  const TempFolder folder;
  nlohmann::json document = gltf_document();
  document["nodes"] = nlohmann::json::array();
  constexpr int length = 20'000;
  for (int i = 0; i < length; ++i) document["nodes"].push_back({{"children", {i + 1}}});
  document["nodes"].push_back({{"mesh", 0}});
  EXPECT_NO_THROW(read_any_mesh(folder.write("a.glb", glb(document, gltf_binary()))));
  document["nodes"].back()["children"] = {0};
  expect_refusal([&] { read_any_mesh(folder.write("a.glb", glb(document, gltf_binary()))); }, "reached twice");
}

// Buffers must lie in the file's folder, also when reached through links, unless the caller permits other places.
TEST(HostileFiles, BuffersStayInTheirFolder) {
  const TempFolder folder;
  fs::create_directories(folder / "scene/below");
  static_cast<void>(folder.write("square.bin", gltf_binary()));
  static_cast<void>(folder.write("scene/below/square.bin", gltf_binary()));
  fs::create_symlink(folder / "square.bin", folder / "scene/out.bin");
  fs::create_directory_symlink(folder.path(), folder / "scene/up");
  fs::create_symlink("below/square.bin", folder / "scene/in.bin");
  const auto with_buffer = [&](const std::string& uri) {
    nlohmann::json document = gltf_document();
    document["buffers"][0]["uri"] = uri;
    return folder.write("scene/a.gltf", document.dump());
  };
  for (const std::string& uri : {std::string("in.bin"), std::string("below/square.bin"), std::string("below/../in.bin")})
    EXPECT_NO_THROW(read_any_mesh(with_buffer(uri))) << uri;
  for (const std::string& uri : {std::string("out.bin"), std::string("up/square.bin"), std::string("../square.bin"),
                                 std::string("%2e%2e/square.bin"), (folder / "square.bin").string()}) {
    SCOPED_TRACE(uri);
    const fs::path file = with_buffer(uri);
    expect_refusal([&] { read_any_mesh(file); }, "must lie in the glTF file's folder");
    EXPECT_NO_THROW(static_cast<void>(read_mesh(file, {.allow_outside = true})));
  }
  expect_refusal([&] { read_any_mesh(with_buffer("a%00.bin")); }, "must name a file");
  ASSERT_EQ(::mkfifo((folder / "scene/pipe.bin").c_str(), 0600), 0);
  expect_refusal([&] { read_any_mesh(with_buffer("pipe.bin")); }, "not a regular file");
}

TEST(HostileFiles, NamesAreTextOnOneLine) {
  const TempFolder folder;
  const auto with_organ = [&](const std::string& organ) {
    nlohmann::json document = gltf_document();
    document["nodes"][0]["extras"] = {{"organ", organ}};
    return folder.write("a.glb", glb(document, gltf_binary()));
  };
  expect_refusal([&] { read_any_mesh(with_organ("le\naf")); }, "control characters");
  expect_refusal([&] { read_any_mesh(with_organ(std::string("le\0af", 5))); }, "control characters");
  expect_refusal([&] { read_any_mesh(with_organ(std::string(201, 'l'))); }, "200 bytes");
  EXPECT_NO_THROW(read_any_mesh(with_organ("bl\xc3\xa4tter \xf0\x9f\x8c\xbd")));
  const auto obj = [&](const std::string& line) {
    return folder.write("a.obj", line + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  };
  expect_refusal([&] { read_any_mesh(obj("usemtl bl\xe4tter")); }, "not UTF-8");
  expect_refusal([&] { read_any_mesh(obj("o plant1_bl\xe4tter")); }, "not UTF-8");
  for (const char* bad : {"\x80", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\xf8\x88\x80\x80\x80"})
    EXPECT_FALSE(is_utf8(bad));
  for (const char* good : {"", "a", "\xc2\x80", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
    EXPECT_TRUE(is_utf8(good));
}

// The check takes linear time: comparing two million names with one another would take hours.
TEST(HostileFiles, ATableHasAThousandColumnsAtMost) {
  const TempFolder folder;
  std::string header = "height_m,sunfleck_ratio";
  for (int i = 0; i < 1'000'000; ++i) header += fmt::format(",c{}", i);
  expect_refusal([&] { static_cast<void>(read_measured(folder.write("a.csv", header + "\n"))); }, "columns");
}

// Nested lists would overflow the stack of a recursive parser; 0x81 is a list of one in CBOR.
TEST(HostileFiles, DeepStoresAreRefused) {
  const TempFolder folder;
  const std::string deep(10'000'000, '\x81');
  expect_refusal([&] { static_cast<void>(read_result_store(folder.write("pictures.cbor", deep))); }, "damaged");
  RadiationModel model;
  model.bands.resize(1);
  const StepStore store(folder.path(), model, {{"seed", 1}}, StepFields::kept);
  fs::create_directory(folder / "steps");
  const auto sum = static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(deep.data()), deep.size()));
  std::string step = "SUNSTEP9";
  append(step, sum);
  static_cast<void>(folder.write("steps/step_00000.bin", step + deep));
  EXPECT_FALSE(store.read(0));
  static_cast<void>(folder.write("steps/settings.json", "{\"finished\":true,\"seed\":" + std::string(1'000'000, '[')));
  expect_refusal([&] { static_cast<void>(store.find()); }, "damaged");
  const std::string list = std::string(100'000, '[') + std::string(100'000, ']');
  static_cast<void>(folder.write("steps/settings.json", "{\"finished\":true,\"seed\":" + list + "}"));
  expect_refusal([&] { static_cast<void>(store.find()); }, "damaged");
}

TEST(HostileFiles, StoredNumbersAreWholeAndInRange) {
  using nlohmann::json;
  EXPECT_EQ(whole<std::uint32_t>(json(4294967295U)), 4294967295U);
  EXPECT_EQ(whole<int>(json(-7)), -7);
  EXPECT_EQ(whole<std::uint64_t>(json(18446744073709551615U)), 18446744073709551615U);
  EXPECT_THROW(static_cast<void>(whole<int>(json(18446744073709551615U))), std::runtime_error);
  EXPECT_THROW(static_cast<void>(whole<std::uint32_t>(json(-1))), std::runtime_error);
  EXPECT_THROW(static_cast<void>(whole<std::uint32_t>(json(1e300))), std::runtime_error);
  EXPECT_THROW(static_cast<void>(whole<std::uint32_t>(json("7"))), std::runtime_error);
}

}  // namespace
}  // namespace sunfleck
