#include "files/scene/scene_reader.h"

#include "support/scene_text.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace sunfleck {
namespace {

// Damages a file's end, a key or a value: reading must give a scene or one error line.
class SceneUnderAttack : public SceneFolder {
 protected:
  void attack(const std::string& text) {
    const auto message = message_of([&] { static_cast<void>(read(text)); });
    if (!message) return;
    expect_three_parts(*message);
    ++refusals_;
    if (HasFailure()) FAIL() << "after this text:\n" << text;
  }
  int refusals_ = 0;
};

TEST_F(SceneUnderAttack, CutAtEveryLength) {
  for (const std::string& scene : {good_scene, lit_scene}) {
    refusals_ = 0;
    for (std::size_t length = 0; length < scene.size(); ++length) attack(scene.substr(0, length));
    EXPECT_GT(refusals_, static_cast<int>(scene.size() / 4));
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    lines.push_back(text.substr(at, end - at));
    at = end;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

const std::vector<std::string> values = {"-1",
                                         "0",
                                         "1",
                                         "1e30",
                                         "-1e30",
                                         "1e-320",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "nan",
                                         "-nan",
                                         "inf",
                                         "-inf",
                                         "true",
                                         "\"\"",
                                         "\"text\"",
                                         "\"..\"",
                                         "\"/\"",
                                         "[]",
                                         "[[]]",
                                         "[[[1]]]",
                                         "[1]",
                                         "[1, 2]",
                                         "[1, 2, 3]",
                                         "[[1, 2, 3]]",
                                         "[nan, inf]",
                                         "[\"a\", 1]",
                                         "[{}]",
                                         "{}",
                                         "{ PAR = 1 }",
                                         "{ PAR = nan, NIR_1 = {} }",
                                         "1979-05-27",
                                         "07:32:00",
                                         "1979-05-27T07:32:00",
                                         "1979-05-27T07:32:00Z",
                                         "9999-12-31T23:59:59.999-23:59",
                                         "0000-01-01T00:00:00+23:59"};

class SceneLinesUnderAttack : public SceneUnderAttack {
 protected:
  // Removes and doubles every line, and replaces its value; returns how many lines have a value.
  int attack_lines(const std::string& scene) {
    const std::vector<std::string> lines = lines_of(scene);
    int keys = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::vector<std::string> changed = lines;
      changed[i] = "";
      attack(joined(changed));
      changed[i] = lines[i] + lines[i];
      attack(joined(changed));
      const std::size_t equals = lines[i].find('=');
      if (equals == std::string::npos) continue;
      ++keys;
      for (const std::string& value : values) {
        changed[i] = lines[i].substr(0, equals + 1) + " " + value + "\n";
        attack(joined(changed));
      }
    }
    return keys;
  }
};

TEST_F(SceneLinesUnderAttack, EveryLineRemovedDoubledOrChanged) {
  EXPECT_EQ(attack_lines(good_scene), 33);
  EXPECT_GT(refusals_, 20 * 33);
}

TEST_F(SceneLinesUnderAttack, EveryLineOfLightAndReceivers) {
  EXPECT_EQ(attack_lines(lit_scene), 26);
  EXPECT_GT(refusals_, 20 * 26);
}

TEST_F(SceneUnderAttack, EveryNumberReplaced) {
  const std::string digits = "0123456789";
  int numbers = 0;
  for (const std::string& scene : {good_scene, lit_scene}) {
    for (std::size_t at = 0; at < scene.size();) {
      if (digits.find(scene[at]) == std::string::npos) {
        ++at;
        continue;
      }
      ++numbers;
      const std::size_t end = scene.find_first_not_of(digits + ".", at);
      for (const char* number : {"-7", "1e300", "nan", "inf", "\"7\"", "true", "99999999999999999999"}) {
        attack(scene.substr(0, at) + number + scene.substr(end));
      }
      at = end;
    }
  }
  EXPECT_GT(numbers, 60);
  EXPECT_GT(refusals_, 6 * numbers) << "of seven a number";
}

TEST_F(SceneUnderAttack, BytesChangedAtRandom) {
  std::mt19937 random(20020808);
  const std::string alphabet = "[]{}=.,\"'#\n\\ \t-+_aeyz019\xff\xc3\x01";
  for (int round = 0; round < 2000; ++round) {
    std::string text = round % 2 == 0 ? good_scene : lit_scene;
    for (unsigned edit = 0; edit <= random() % 3; ++edit) text[random() % text.size()] = alphabet[random() % alphabet.size()];
    attack(text);
  }
  EXPECT_GT(refusals_, 650);
}

}  // namespace
}  // namespace sunfleck
