// Tests a scene's list of the files that it was read from, and the digest made from them.

#include "simulate/scene_source.h"
#include "support/caribu_files.h"
#include "support/mesh_files.h"
#include "support/scene_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

// Refers to weather, a list of lights, a text mesh, and a mesh whose numbers lie in a third file.
const std::string text_of_all =
    "[plot]\nsize = [4.0, 4.0]\n"
    "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.02\nlongitude = 116.28\n"
    "[sky]\nmodel = \"lights\"\nfile = \"sky.light\"\n"
    "[weather]\nfile = \"station.csv\"\n"
    "[[band]]\nname = \"PAR\"\nshare = 0.5\n"
    "[optics.leaf]\nreflectance = 0.1\n"
    "[[geometry]]\nfile = \"first.obj\"\noptics = \"leaf\"\n"
    "[[geometry]]\nfile = \"stand.gltf\"\noptics = \"leaf\"\n";

std::string gltf_beside(const std::string& buffer) {
  nlohmann::json document = gltf_document();
  document["buffers"][0]["uri"] = buffer;
  return document.dump();
}

class SceneSources : public ::testing::Test {
 protected:
  SceneSources() { fill(folder_.path()); }

  static void fill(const fs::path& folder) {
    fs::create_directories(folder / "parts");
    write(folder / "scene.toml", text_of_all);
    write(folder / "sky.light", "0.75 0 0 -1\n0.5 0.5 0.5 -0.7\n");
    write(folder / "station.csv", station_csv);
    write(folder / "first.obj", obj_square());
    write(folder / "stand.gltf", gltf_beside("parts/stand.bin"));
    write(folder / "parts" / "stand.bin", gltf_binary());
    write(folder / "stand.can", can_square());
    write(folder / "par.opt", grey_opt);
    write(folder / "nir.opt", grey_opt);
    write(folder / "sun.light", "350 -1 0 -1\n");
    write(folder / "plot.8", "0 0\n4 4\n");
  }

  [[nodiscard]] Scene scene() const { return load_scene({folder_ / "scene.toml"}); }
  [[nodiscard]] Scene stand(const std::string& canopy = "stand.can", const std::string& light = "sun.light") const {
    StandFiles files;
    files.optics = {(folder_ / "par.opt").string(), (folder_ / "nir.opt").string()};
    files.light = folder_ / light;
    files.domain = folder_ / "plot.8";
    return load_scene({folder_ / canopy, files});
  }

  // Returns the names, within the folder, of the files that a scene was read from, each once.
  [[nodiscard]] std::set<std::string> names(const std::vector<SourceFile>& files) const {
    std::set<std::string> names;
    for (const SourceFile& file : files) names.insert(fs::relative(file.path, folder_.path()).generic_string());
    return names;
  }

  // Expects another digest if the file has other bytes, and the first digest again with the first bytes.
  void expect_covered(const std::string& name, const std::string& bytes, const std::function<Scene()>& read) const {
    SCOPED_TRACE(name);
    const std::string before = read().digest;
    const std::string old = read_file(folder_ / name);
    ASSERT_NE(bytes, old);
    write(folder_ / name, bytes);
    EXPECT_NE(read().digest, before);
    write(folder_ / name, old);
    EXPECT_EQ(read().digest, before);
  }

  TempFolder folder_;
};

TEST_F(SceneSources, AreAllInTheList) {
  EXPECT_EQ(names(scene().files),
            (std::set<std::string>{"scene.toml", "sky.light", "station.csv", "first.obj", "stand.gltf", "parts/stand.bin"}));
  EXPECT_EQ(names(stand().files), (std::set<std::string>{"stand.can", "par.opt", "nir.opt", "sun.light", "plot.8"}));
  write(folder_ / "leaf.gltf", gltf_beside("parts/stand.bin"));
  EXPECT_EQ(names(stand("leaf.gltf", "sky.light").files),
            (std::set<std::string>{"leaf.gltf", "parts/stand.bin", "par.opt", "nir.opt", "sky.light", "plot.8"}));
}

TEST_F(SceneSources, AreAllInTheDigest) {
  const auto of_scene = [this] { return scene(); };
  expect_covered("scene.toml", text_of_all + "# more\n", of_scene);
  expect_covered("sky.light", "0.5 0 0 -1\n", of_scene);
  expect_covered("station.csv", replaced(station_csv, "400", "410"), of_scene);
  expect_covered("first.obj", replaced(obj_square(), "v 1 1 0", "v 1 1 0.5"), of_scene);
  expect_covered("stand.gltf", gltf_beside("parts/../parts/stand.bin"), of_scene);
  std::string buffer = gltf_binary();
  buffer[3] = '\x3f';  // makes the first coordinate 0.5
  expect_covered("parts/stand.bin", buffer, of_scene);

  const auto of_stand = [this] { return stand(); };
  expect_covered("stand.can", can_square() + "# more\n", of_stand);
  expect_covered("par.opt", replaced(grey_opt, "s d 0.15", "s d 0.16"), of_stand);
  expect_covered("nir.opt", replaced(grey_opt, "d 0.12 0.06", "d 0.12 0.07"), of_stand);
  expect_covered("sun.light", "350 -1 0 -1.5\n", of_stand);
  expect_covered("plot.8", "0 0\n4 5\n", of_stand);
  expect_covered("sky.light", "0.5 0 0 -1\n", [this] { return stand("stand.can", "sky.light"); });
}

TEST_F(SceneSources, CountWithTheirOwnContent) {
  const std::string two = replaced(text_of_all, "stand.gltf", "second.obj");
  write(folder_ / "scene.toml", two);
  write(folder_ / "first.obj", obj_square() + "# here\n");
  write(folder_ / "second.obj", obj_square());
  const std::string digest = scene().digest;
  write(folder_ / "first.obj", obj_square());
  write(folder_ / "second.obj", "# here\n" + obj_square());
  EXPECT_NE(scene().digest, digest) << "a line went from the end of one file to the beginning of the next";
}

TEST_F(SceneSources, MayLieAnywhere) {
  const TempFolder other_root;
  const fs::path other = other_root / "elsewhere";
  fill(other);
  EXPECT_EQ(load_scene({other / "scene.toml"}).digest, scene().digest);
}

// A mesh may refer to files of its own, which stay in its folder.
TEST_F(SceneSources, ThatTheUserNamesMayLieOutsideTheFolder) {
  write(folder_ / "leaf.gltf", gltf_beside("parts/stand.bin"));
  const TempFolder elsewhere;
  write(elsewhere / "far.light", "0.75 0 0 -1\n0.5 0.5 0.5 -0.7\n");
  for (const std::string canopy : {"stand.can", "leaf.gltf"}) {
    const Scene far = stand(canopy, (elsewhere / "far.light").string()), near = stand(canopy, "sky.light");
    ASSERT_TRUE(far.model.sky && near.model.sky) << canopy;
    EXPECT_EQ(far.model.sky->lights.size(), 2U) << canopy;
    EXPECT_EQ(far.files.size(), near.files.size()) << canopy;
  }
}

TEST_F(SceneSources, OfASceneThatFailsAreListedToo) {
  const auto tried = [this](const std::string& names_of) {
    SourceFiles files;
    EXPECT_TRUE(message_of([&] { static_cast<void>(load_scene({folder_ / "scene.toml"}, ScenePurpose::moment, &files)); }))
        << names_of;
    return files.list();
  };
  write(folder_ / "first.obj", "f 1 2 3\n");
  EXPECT_TRUE(names(tried("broken")).contains("first.obj"));
  fs::remove(folder_ / "first.obj");
  const std::vector<SourceFile> without = tried("missing");
  const auto missing = std::find_if(without.begin(), without.end(), [](const SourceFile& f) { return !f.stamp; });
  ASSERT_NE(missing, without.end());
  EXPECT_EQ(missing->path.filename(), "first.obj");
  write(folder_ / "first.obj", obj_square());
  fs::remove(folder_ / "parts" / "stand.bin");
  EXPECT_TRUE(names(tried("without its buffer")).contains("parts/stand.bin"));
}

TEST_F(SceneSources, OfOtherLightJoinTheList) {
  Scene with_light = scene();
  const std::size_t count = with_light.files.size();
  write(folder_ / "clear.light", "1 0 0 -1\n");
  const std::string text = replaced(text_of_all, "sky.light", "clear.light");
  for (int again = 0; again < 3; ++again) relight(with_light, SceneText{folder_ / "scene.toml", text, {}});
  EXPECT_EQ(names(with_light.files), (std::set<std::string>{"scene.toml", "sky.light", "clear.light", "station.csv",
                                                            "first.obj", "stand.gltf", "parts/stand.bin"}));
  EXPECT_LE(with_light.files.size(), count + 2) << "it grows with every light";
}

TEST_F(SceneSources, StampsTellWritesAndLinksApart) {
  const std::optional<FileStamp> stamp = stamp_of(folder_ / "first.obj");
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp_of(folder_ / "first.obj"), stamp);
  EXPECT_FALSE(stamp_of(folder_ / "none.obj"));
  write(folder_ / "new.obj", obj_square());
  const auto time = fs::last_write_time(folder_ / "first.obj");
  fs::last_write_time(folder_ / "new.obj", time);
  EXPECT_NE(stamp_of(folder_ / "new.obj"), stamp) << "another file, as old and as long";
  fs::create_symlink("first.obj", folder_ / "link.obj");
  EXPECT_EQ(stamp_of(folder_ / "link.obj"), stamp);
  fs::remove(folder_ / "link.obj");
  fs::create_symlink("new.obj", folder_ / "link.obj");
  EXPECT_NE(stamp_of(folder_ / "link.obj"), stamp);
}

TEST_F(SceneSources, AMeshAloneGetsASceneWhereItIsAllowed) {
  const Scene made = load_scene({.scene = folder_ / "stand.gltf", .mesh_alone = true});
  EXPECT_EQ(made.model.canopy.size(), 2U);
  EXPECT_EQ(made.title, "stand");
  std::set<std::string> files;
  for (const SourceFile& file : made.files) files.insert(file.path.filename().string());
  EXPECT_EQ(files, (std::set<std::string>{"stand.gltf", "stand.bin"}));  // the window watches both
  EXPECT_THROW(static_cast<void>(load_scene({.scene = folder_ / "stand.gltf"})), Error);
}

}  // namespace
}  // namespace sunfleck
