// Every key of a scene file, at a value that is not its default: written and read again, in the hash, in the
// records of a run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "plan/plan.hpp"
#include "report/run_record.hpp"
#include "scene/effect_keys.hpp"
#include "scene/scene_keys.hpp"
#include "scene/scene_toml.hpp"
#include "scene/scene_writer.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

Scene scene_of(EffectKind kind) {
  Scene scene;
  scene.mesh_file = "/meshes/a \"quoted\\\" name.obj";
  scene.effects = {default_effect(kind)};
  scene.realtime = kind == EffectKind::ssao;
  return scene;
}

// A value of the domain other than `now`. `words`: the choice's that can be had.
KeyValue another(const Domain& domain, const KeyValue& now, std::size_t word) {
  using Form = Domain::Form;
  switch (domain.form) {
    case Form::boolean:
      return !std::get<bool>(now);
    case Form::integer:
      return std::get<std::int64_t>(now) < domain.hi ? std::get<std::int64_t>(now) + 1
                                                     : std::int64_t(domain.lo);
    case Form::number:
      return domain.lo > -1e29 && domain.hi < 1e29 ? 0.37 * domain.lo + 0.63 * domain.hi : 1.2345678;
    case Form::point:
      return dvec3(1.5, -2.1, 3.3);
    case Form::scale:
      return dvec3(2, 0.1, -1);
    case Form::choice:
    case Form::view:
    case Form::color:
      return std::string(domain.words[word]);
    case Form::names:
      return std::vector<std::string>{"leaf", "a \"stem\""};
    case Form::crop:
      return PixelRect{1, 2, 30, 40};
    default:
      return "other";
  }
}

Scene read_again(const std::string& text) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "scene.toml", text);
  return load_scene(folder / "scene.toml");
}

// Written and read again, the scene is the same, and its hash differs from the unchanged one's as it should.
void expect_kept(const Scene& scene, const Scene& unchanged, const KeyInfo& key) {
  const std::string text = to_toml(scene);
  EXPECT_NE(text, to_toml(unchanged)) << key.name << " is not written";
  Scene again;
  ASSERT_NO_THROW(again = read_again(text)) << text;
  EXPECT_EQ(to_toml(again), text);
  EXPECT_EQ(scene_hash(again), scene_hash(scene)) << key.name;
  EXPECT_EQ(scene_hash(scene) != scene_hash(unchanged), key.of_samples) << key.name;
}

// `name` = `text` among the attributes, and in the run record's only effect.
void expect_recorded(const Effect& effect, const KeyInfo& key, const KeyValue& value) {
  RunRecord record;
  EffectPlan planned;
  planned.effect = effect;
  planned.max_distance = resolve_distance(effect, Bounds3{vec3(0), vec3(1)}.bounding_radius(), false);
  record.plan.effects = {planned};
  const std::string name(key.recorded_as());
  const KeyValue known = key.name == "max_distance" ? KeyValue(planned.max_distance) : value;
  EXPECT_EQ(record.metadata().at("nook/" + name), plain_text(known));
  const test::TemporaryFolder folder;
  write_stats(folder / "stats.json", record);
  const nlohmann::json written = nlohmann::json::parse(test::read_bytes(folder / "stats.json"))["effects"][0];
  ASSERT_TRUE(written.contains(name)) << name;
  if (const auto* number = std::get_if<float>(&known))
    EXPECT_EQ(written[name].get<float>(), *number);
  else if (const auto* list = std::get_if<std::vector<std::string>>(&known))
    EXPECT_EQ(written[name].get<std::vector<std::string>>(), *list);
  else
    EXPECT_EQ(written[name].get<std::string>(), plain_text(known));
}

TEST(SceneKeys, EveryKeyOfEveryEffectIsReadWrittenHashedAndRecorded) {
  int walked = 0;
  for (const auto& [type, kind] : effect_names)
    for (const Key<Effect>& key : effect_keys()) {
      if (!key.info.readers.contains(kind) || key.info.name == "type") continue;
      SCOPED_TRACE(fmt::format("{} of type {}", key.info.name, type));
      const Scene unchanged = scene_of(kind);
      const std::size_t values =
          key.info.domain.form == Domain::Form::choice ? key.info.domain.words.size() : 1;
      int other = 0;
      for (std::size_t word = 0; word < values; ++word) {
        Scene scene = unchanged;
        Effect& effect = scene.effects.front();
        const KeyValue before = key.field.get(effect), value = another(key.info.domain, before, word);
        give(effect, key, value);
        settle(effect);
        const KeyValue now = key.field.get(effect);
        if (now == before || conflict_of(effect)) continue;
        expect_kept(scene, unchanged, key.info);
        if (key.info.readers != all_kinds) {
          EXPECT_NE(settings_text(effect), settings_text(unchanged.effects.front())) << "not in reports";
          if (is_traced(kind)) expect_recorded(effect, key.info, now);
        }
        ++other;
        ++walked;
      }
      EXPECT_GT(other, 0);
    }
  EXPECT_GT(walked, 50);
}

TEST(SceneKeys, WordsInTheirPlaceAreKeptToo) {
  for (const Key<Effect>& key : effect_keys())
    for (const std::string_view word : key.info.domain.words) {
      if (key.info.domain.form == Domain::Form::choice) continue;
      for (const auto& [type, kind] : effect_names) {
        if (!key.info.readers.contains(kind)) continue;
        Scene scene = scene_of(kind);
        key.field.set(scene.effects.front(), std::string(word));
        EXPECT_EQ(key.field.get(scene.effects.front()), KeyValue(std::string(word))) << key.info.name;
        EXPECT_EQ(to_toml(read_again(to_toml(scene))), to_toml(scene)) << key.info.name << " " << word;
      }
    }
}

// One table of keys of a scene that `owner` gives.
template <class Owner, class OwnerOf>
int walk(std::span<const Key<Owner>> keys, const Scene& base, OwnerOf owner) {
  int walked = 0;
  for (const Key<Owner>& key : keys) {
    SCOPED_TRACE(std::string(key.info.name));
    Scene scene = base;
    if (!key.in_use(owner(scene))) continue;
    const KeyValue before = key.field.get(owner(scene));
    if (std::holds_alternative<std::monostate>(before) && key.info.domain.form == Domain::Form::files)
      continue;
    const bool needs_instances = key.info.name == "instancing" && base.instances.empty();
    if (needs_instances) continue;
    for (std::size_t word = 0; word < std::max<std::size_t>(1, key.info.domain.words.size()); ++word) {
      key.field.set(owner(scene), another(key.info.domain, before, word));
      if (key.field.get(owner(scene)) == before) continue;
      if (key.info.name == "objfile") key.field.set(owner(scene), "/other.obj");
      expect_kept(scene, base, key.info);
      ++walked;
      break;
    }
  }
  return walked;
}

TEST(SceneKeys, EveryOtherKeyIsReadWrittenAndHashed) {
  const auto whole = [](Scene& scene) -> Scene& { return scene; };
  Scene fixed = scene_of(EffectKind::ao);
  fixed.direction_choice = Scene::DirectionChoice::given;  // else an error has them chosen
  Scene to_error = fixed, placed = fixed, on_ground = fixed, framed = fixed;
  framed.automatic_camera = true;
  to_error.stop.error = 0.05;
  placed.mesh_file = "/a.obj";
  placed.instances = {{"/a.obj"}, {"/b.obj"}};
  on_ground.ground.emplace();
  Scene offline = scene_of(EffectKind::ssao);
  offline.realtime = false;
  EXPECT_EQ(walk(renderer_keys().first(1), offline, whole), 1);  // realtime: goes with type ssao alone
  const std::size_t of_renderer = renderer_keys().size() - 1;
  EXPECT_EQ(walk(renderer_keys().subspan(1), fixed, whole), int(of_renderer) - 3);  // less what needs a stop
  EXPECT_EQ(walk(renderer_keys().subspan(1), to_error, whole), int(of_renderer) - 1);  // less spp
  EXPECT_EQ(walk(input_keys(), fixed, whole) + walk(input_keys(), placed, whole), 2 + 2);
  EXPECT_EQ(walk(film_keys(), fixed, whole), int(film_keys().size()));
  EXPECT_EQ(walk(camera_keys(), fixed, whole), int(camera_keys().size()) - 2);   // less view and margin
  EXPECT_EQ(walk(camera_keys(), framed, whole), int(camera_keys().size()) - 2);  // less eye and at
  EXPECT_EQ(walk(instance_keys(), placed, [](Scene& s) -> Instance& { return s.instances[1]; }),
            int(instance_keys().size()));
  EXPECT_EQ(walk(ground_keys(), on_ground, [](Scene& s) -> Ground& { return *s.ground; }),
            int(ground_keys().size()));
}

// A camera that frames the mesh is no camera at the default place.
TEST(SceneKeys, AnAutomaticCameraIsKept) {
  Scene scene = scene_of_mesh("/mesh.obj");
  scene.camera.fov = 40;
  const Scene again = read_again(to_toml(scene));
  EXPECT_TRUE(again.automatic_camera);
  EXPECT_EQ(again.camera.fov, 40);
}

TEST(SceneKeys, AViewFramesTheMesh) {
  const Scene scene = read_again("[input]\nobjfile = \"m.obj\"\n[camera]\nview = \"left\"\nup = \"-z\"\n");
  EXPECT_TRUE(scene.automatic_camera);
  EXPECT_EQ(scene.view, (View{-90, 0}));
  EXPECT_EQ(scene.camera.up, vec3(0, 0, -1));
  const Scene again = read_again(to_toml(scene));
  EXPECT_EQ(again.view, scene.view);
  EXPECT_EQ(again.camera.up, scene.camera.up);
}

TEST(SceneKeys, AGroundOfNoneIsNoGround) {
  const std::string start = "[input]\nobjfile = \"m.obj\"\n[ground]\nup = \"-x\"\n";
  EXPECT_EQ(read_again(start).ground->up, Axis::minus_x);
  EXPECT_FALSE(read_again(start + "height = \"none\"\n").ground);
}

TEST(SceneKeys, NoFlagIsTwoKeys) {
  std::vector<std::string_view> flags;
  for (const auto keys : {camera_keys(), film_keys(), renderer_keys()})
    for (const Key<Scene>& key : keys) flags.push_back(key.info.flag);
  for (const Key<Ground>& key : ground_keys()) flags.push_back(key.info.flag);
  for (const Key<Effect>& key : effect_keys()) flags.push_back(key.info.flag);
  std::erase(flags, "");
  EXPECT_GT(flags.size(), 12u);
  for (const std::string_view flag : flags) {
    EXPECT_EQ(std::count(flags.begin(), flags.end(), flag), 1) << flag;
    EXPECT_EQ(key_of_flag(flag)->flag, flag);
  }
  EXPECT_EQ(key_of_flag("--max-distance")->variable(), "NOOK_MAX_DISTANCE");
}

}  // namespace
}  // namespace nook
