// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/default_lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pointrt {

namespace {

using std::numbers::pi;

/// Room sizes in multiples of the scene's bounding radius. Mirrors are close, so that reflections are large; matte
/// walls are farther away, so that the lights leave no bright spots on them.
struct RoomSize {
    double half_width, height;
};
constexpr RoomSize kMirrorRoom{1.8, 3.0};
constexpr RoomSize kMatteRoom{3.6, 5.0};
constexpr Color kMatteWall{0.42f, 0.42f, 0.43f};
/// Silvered glass reflects nine tenths of the light, and slightly less of the blue.
constexpr Color kMirrorWall{0.90f, 0.90f, 0.88f};

/// The ring of lights, in bounding radii. It is inside both rooms: their floor is at most 1 below the centre, so their
/// ceilings are above it.
constexpr double kRingRadius = 1.5;
constexpr double kRingHeight = 1.9;
/// Smallest distance between the eye and the wall behind it, in bounding radii.
constexpr double kEyeMargin = 0.05;
/// The angle of the first light: left of the eye, like a key light.
constexpr double kKeyLightAngle = -40.0 * pi / 180.0;
/// Radiance of a white surface at the scene's centre that faces all lights together.
constexpr double kLightSum = 1.5;

struct Staging {
    Vec3 center, eye, up;
    Vec3 towards_eye, right; ///< horizontal unit vectors
    double radius = 0;       ///< radius of the sphere around the bounds
    double floor = 0;        ///< lowest point along up, measured from center
};

/// The axis nearest to v, so that floors are level in scans whose up is slightly off.
Vec3 nearestAxis(Vec3 v) {
    const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    if (y >= x && y >= z) return {0, std::copysign(1.0, v.y), 0};
    return z >= x ? Vec3{0, 0, std::copysign(1.0, v.z)} : Vec3{std::copysign(1.0, v.x), 0, 0};
}

Staging stageBounds(Vec3 up, Vec3 eye, Vec3 low, Vec3 high) {
    Staging staging;
    staging.center = 0.5 * (low + high);
    staging.eye = eye;
    staging.up = up;
    staging.radius = 0.5 * length(high - low);
    if (!(staging.radius > 0)) staging.radius = 1; // a single splat has radius 0, see frameCamera
    staging.floor = -0.5 * dot(high - low, absolute(up));
    const Vec3 side = std::abs(up.y) > 0.5 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
    Vec3 towards_eye = staging.eye - staging.center;
    towards_eye = towards_eye - dot(towards_eye, up) * up;
    staging.towards_eye =
        length(towards_eye) > 1e-6 * staging.radius ? normalize(towards_eye) : normalize(side - dot(side, up) * up);
    staging.right = cross(up, staging.towards_eye);
    return staging;
}

std::uint32_t addMaterial(SceneDescription& scene, const MaterialDescription& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// A box whose floor is at the scene's lowest point; the eye is inside.
void addRoom(SceneDescription& scene, const Staging& staging, Room room) {
    const bool mirror = room == Room::kMirror;
    const RoomSize size = mirror ? kMirrorRoom : kMatteRoom;
    const Vec3 axes[] = {staging.right, staging.up, staging.towards_eye};
    Vec3 half[3], center = staging.center;
    for (int a = 0; a < 3; ++a) {
        const double eye = dot(staging.eye - staging.center, axes[a]), margin = kEyeMargin * staging.radius;
        const double low = a == 1 ? staging.floor : -size.half_width * staging.radius;
        const double high = a == 1 ? staging.floor + size.height * staging.radius : size.half_width * staging.radius;
        const double from = std::min(low, eye - margin), to = std::max(high, eye + margin);
        center = center + 0.5 * (from + to) * axes[a];
        half[a] = 0.5 * (to - from) * axes[a];
    }
    MaterialDescription wall;
    wall.name = "room";
    wall.kind = mirror ? MaterialKind::kMirror : MaterialKind::kMatte;
    wall.color = mirror ? kMirrorWall : kMatteWall;
    scene.shapes.push_back({ShapeKind::kBox, center, half[0], half[1], half[2], addMaterial(scene, wall)});
    scene.shapes.back().of_surroundings = true;
}

/// Lights on a ring above the scene, the first to the left of the eye.
void addRing(SceneDescription& scene, const Staging& staging, std::uint32_t count) {
    const double distance = std::hypot(kRingRadius, kRingHeight) * staging.radius;
    for (std::uint32_t l = 0; l < count; ++l) {
        const double angle = kKeyLightAngle + 2 * pi * l / count;
        const Vec3 around = std::cos(angle) * staging.towards_eye + std::sin(angle) * staging.right;
        const auto intensity = static_cast<float>(pi * kLightSum / count * distance * distance);
        scene.lights.push_back(
            PointLight{staging.center + staging.radius * (kRingRadius * around + kRingHeight * staging.up),
                       {intensity, intensity, intensity}});
    }
}

/// A studio lamp at infinity, which lights the whole floor evenly: angle to the right of the eye, elevation, angular
/// radius (for soft shadows), and the radiance of a white surface that faces it.
struct StudioLamp {
    double angle_deg, height_deg, radius_deg;
    Color light;
};
// Key, fill and rim light as in portrait photography: the key high to one side and slightly warm, the fill large, on
// the other side, at a quarter of the key, the rim behind.
constexpr StudioLamp kStudioLamps[] = {
    {-42, 48, 5, {0.98f, 0.94f, 0.88f}}, {52, 22, 14, {0.22f, 0.24f, 0.27f}}, {160, 35, 8, {0.40f, 0.42f, 0.46f}}};
/// The strength of the lamps, and the brightness of the floor.
struct StudioLight {
    float lamps; ///< factor of kStudioLamps
    float floor; ///< reflectance
};
constexpr StudioLight kDirectStudio{1, 0.42f};
/// If light bounces, sky and floor fill the shadows. Lamps that are a seventh weaker then make a white subject as
/// bright as without bounces, and a floor half as bright preserves its contrast.
constexpr StudioLight kPathStudio{0.86f, 0.21f};
/// How far the floor is below the lowest point, in bounding radii: more than float precision, so that discs flat on the
/// floor stay above it, and so little that shadows still touch their objects.
constexpr double kStudioGap = 1e-3;
/// Radiance of the zenith relative to that of the horizon, which equals the floor's. The zenith is dark, so that the
/// sky adds little light.
constexpr float kStudioZenith = 0.35f;
/// The same for the nadir under open ground; its light reaches crowns and eaves from below.
constexpr float kBelowGround = 0.4f;

/// The lamps are dimmed for subjects with a reflectance above kBright, and brightened for those below kDark, by a
/// factor of at most kMostGain.
constexpr double kBright = 0.75, kDark = 0.25, kMostGain = 2.5;

/// The mean reflectance that renders as a middle grey: for objects under the studio's lamps, and for surroundings,
/// which fill the picture, under the dimmer lamp near the eye.
constexpr double kMiddle = 0.18, kMiddleAround = 0.35;

/// The gain of the lamps for a subject.
float lampGain(const StudioSubject& subject) {
    const double reflectance = std::max(subject.reflectance, 1e-6);
    if (reflectance > kBright) return static_cast<float>(kBright / reflectance);
    const double lift = std::min(kMiddle / std::max(subject.mean_reflectance, 1e-6), kBright / reflectance);
    const double gain = subject.around_eye ? kMiddleAround / reflectance : std::max(kDark / reflectance, lift);
    return static_cast<float>(std::clamp(gain, 1.0, kMostGain));
}

/// The light of a lamp near the eye, as the radiance of a white surface at the distance of the centre, and the light of
/// a dim sky (all_around), which reduces the contrast between near and far surfaces.
struct EyeLamp {
    float lamp, all_around;
};
constexpr EyeLamp kBeforeEye{0.5f, 0.9f};
constexpr EyeLamp kAmongWalls{0.6f, 0.75f};                    // walls occlude much of the sky from each other
constexpr float kAbove = 0.4f, kAcross = 0.36f, kBelow = 0.3f; // floors, walls and ceilings differ in brightness
/// Between walls, the lamp is raised by this share of the way from the eye to the ceiling, so that nearby objects at
/// eye level are not too bright and cast visible shadows.
constexpr double kLampHeight = 0.5;

void addEyeLamp(SceneDescription& scene, const Staging& staging, const StudioSubject& subject) {
    const float gain = lampGain(subject);
    const Vec3 to_centre = staging.center - staging.eye;
    const bool central = length(to_centre) < staging.radius / 2;
    // with many rooms, the centre and the height of the whole scene say nothing about this one
    const bool own_room = subject.walls && !central;
    const double distance = own_room ? subject.walls->distance : std::max(length(to_centre), 0.25 * staging.radius);
    // above and left of the eye, so that surfaces have shading. Without walls, the lamp is as far behind the eye as the
    // centre is in front of it, so that near surfaces do not get much more light than far ones
    const bool walled = central || own_room;
    const double headroom =
        own_room ? subject.walls->headroom : std::max(0.0, dot(to_centre, staging.up) - staging.floor);
    const Vec3 aside = 0.1 * distance * (staging.up - staging.right);
    const Vec3 place = staging.eye + aside + (walled ? kLampHeight * headroom * staging.up : -1.0 * to_centre);
    const double reach = walled ? distance : 2 * distance;
    const EyeLamp share = walled ? kAmongWalls : kBeforeEye;
    const auto intensity = static_cast<float>(pi * share.lamp * gain * reach * reach);
    scene.lights.push_back(PointLight{place, {intensity, intensity, intensity}});
    SkyDescription sky;
    sky.ambient = std::min(1.0f, share.all_around * gain);
    sky.zenith = {kAbove, kAbove, kAbove};
    sky.horizon = {kAcross, kAcross, kAcross};
    sky.ground = {kBelow, kBelow, kBelow};
    scene.sky = sky;
}

void addFloor(SceneDescription& scene, const Staging& staging, double level, float grey) {
    MaterialDescription floor;
    floor.name = "studio floor";
    floor.color = {grey, grey, grey};
    ShapeDescription plane{ShapeKind::kPlane, staging.center + level * staging.up,
                           staging.right,     -1.0 * staging.towards_eye,
                           staging.up,        addMaterial(scene, floor)};
    plane.backdrop = plane.of_surroundings = true;
    scene.shapes.push_back(plane);
}

/// For path tracing: the sky's light on a level floor relative to that of a sky as bright as its horizon. The gradient
/// follows the square root of the height; its cosine-weighted mean is 0.2 horizon + 0.8 zenith.
constexpr float kSkyOnFloor = 0.2f + 0.8f * kStudioZenith;

/// A sky whose horizon is as bright as the floor. lit_floor: the floor's radiance due to the lamps. Open ground has no
/// floor around it: there the sky darkens below the horizon, where cameras above the ground look.
SkyDescription studioSky(Color lit_floor, const StudioLight& light, const StudioSubject& subject) {
    const bool is_path_traced = subject.is_path_traced;
    SkyDescription sky;
    for (int c = 0; c < 3; ++c) {
        sky.horizon[c] = is_path_traced ? lit_floor[c] / (1 - light.floor * kSkyOnFloor) : lit_floor[c];
        sky.zenith[c] = kStudioZenith * sky.horizon[c];
        sky.ground[c] = subject.is_ground ? kBelowGround * sky.horizon[c] : sky.horizon[c];
        // ambient light that the floor receives
        if (!is_path_traced) sky.horizon[c] += light.floor * sky.ambient * sky.zenith[c];
    }
    return sky;
}

void addStudio(SceneDescription& scene, const Staging& staging, const StudioSubject& subject, bool has_floor) {
    const StudioLight studio = subject.is_path_traced ? kPathStudio : kDirectStudio;
    const float gain = lampGain(subject), grey = studio.floor / gain;
    if (subject.around_eye) return addEyeLamp(scene, staging, subject);
    const double level = staging.floor - kStudioGap * staging.radius;
    // a camera below the scene would see only the floor: leave it out, and put the lamps below, too
    const bool below = dot(staging.eye - staging.center, staging.up) <= level;
    if (has_floor && !below && !subject.is_ground) addFloor(scene, staging, level, grey);
    const Vec3 lamps_up = (below ? -1.0 : 1.0) * staging.up;
    Color lit_floor{0, 0, 0};
    for (const StudioLamp& lamp : kStudioLamps) {
        const double angle = lamp.angle_deg * pi / 180, height = lamp.height_deg * pi / 180;
        const Vec3 across = std::cos(angle) * staging.towards_eye + std::sin(angle) * staging.right;
        SunLight light{std::cos(height) * across + std::sin(height) * lamps_up, lamp.radius_deg, lamp.light};
        for (int c = 0; c < 3; ++c) {
            light.irradiance[c] = static_cast<float>(pi) * studio.lamps * lamp.light[c] * gain;
            lit_floor[c] += studio.floor * studio.lamps * lamp.light[c] * static_cast<float>(std::sin(height));
        }
        scene.lights.push_back(light);
    }
    scene.sky = studioSky(lit_floor, studio, subject);
}

/// Whether neither scene nor settings choose surroundings.
bool isLeftToDefaults(const SceneDescription& scene, const RenderSettings& settings, const std::optional<Room>& room) {
    const bool is_bare = scene.lights.empty() && scene.shapes.empty() && !scene.sky;
    return is_bare && !room && !settings.lights && castsShadowRays(settings.integrator);
}

/// Lights for an unlit scene in front of a plain background. Gaussian captures contain their own, also for shapes among
/// them.
void addLampsBeforeBackground(SceneDescription& scene, const RenderSettings& settings, const Staging& staging,
                              const StudioSubject& subject, bool in_room) {
    if (!settings.lights && !in_room && subject.only_gaussians) return;
    if (settings.lights || in_room || !scene.shapes.empty())
        return addRing(scene, staging, settings.lights.value_or(kRingLights));
    addStudio(scene, staging, subject, false);
}

/// A sky of one colour. strength and image keep their defaults, so that the sky has exactly that colour.
SkyDescription plainSky(const Background& background, float ambient) {
    SkyDescription sky;
    sky.zenith = sky.horizon = sky.ground = backgroundRadiance(background);
    sky.ambient = ambient;
    return sky;
}

bool isPlain(const SkyDescription& sky, const Background& background) {
    return sky == plainSky(background, sky.ambient);
}

/// Replaces the sky by scene.background. This sky gives ambient light, like the studio's, only to scenes without lights
/// of their own: elsewhere it would brighten what the lights leave dark.
void addBackground(SceneDescription& scene, const RenderSettings& settings, const Staging& staging,
                   const StudioSubject& subject, bool in_room) {
    const bool is_unlit = scene.lights.empty() && !scene.sky;
    const float default_ambient = is_unlit && !subject.only_gaussians ? SkyDescription{}.ambient : 0;
    const float ambient = scene.sky ? scene.sky->ambient : default_ambient;
    if (is_unlit) addLampsBeforeBackground(scene, settings, staging, subject, in_room);
    scene.sky = plainSky(*scene.background, ambient);
}

} // namespace

bool isLitByDefault(const SceneDescription& scene, const RenderSettings& settings) {
    const std::optional<Room> room = settings.room ? settings.room : scene.render.room;
    return !settings.background && isLeftToDefaults(scene, settings, room);
}

Vec3 sceneUp(const SceneDescription& scene, const RenderSettings& settings) {
    if (scene.up) return *scene.up;
    return nearestAxis(settings.camera.up.value_or(Vec3{0, 1, 0}));
}

void addSurroundings(SceneDescription& scene, const RenderSettings& settings, const Camera& camera, Vec3 low, Vec3 high,
                     const StudioSubject& subject) {
    const std::optional<Room> room = settings.room ? settings.room : scene.render.room;
    const Vec3 eye = scene.staged_for.value_or(camera.eye);
    Staging staging = stageBounds(sceneUp(scene, settings), eye, low, high);
    if (subject.lowest) staging.floor = *subject.lowest - dot(staging.center, staging.up);
    const bool by_default = isLeftToDefaults(scene, settings, room);
    const bool is_unlit = scene.lights.empty() && !scene.sky;
    if (!scene.surroundings) scene.surroundings = AddedSurroundings{settings.room, settings.lights, is_unlit};
    scene.background = settings.background;
    if (!scene.background && by_default && subject.only_gaussians) scene.background = Background{};
    if (!scene.background && by_default) return addStudio(scene, staging, subject, true);
    const bool in_room = room && *room != Room::kNone;
    if (scene.background) addBackground(scene, settings, staging, subject, in_room);
    if (in_room) addRoom(scene, staging, *room);
    if (scene.lights.empty() && !scene.sky) addRing(scene, staging, settings.lights.value_or(kRingLights));
}

void ownSurroundings(SceneDescription& scene, RenderSettings& settings) {
    scene.render.room = settings.room = Room::kNone;
    scene.render.lights = settings.lights = 0;
    scene.render.background = settings.background = pictureBackground(scene);
    scene.staged_for.reset();
}

std::optional<Background> pictureBackground(const SceneDescription& scene) {
    const bool is_seen = scene.background && scene.sky && isPlain(*scene.sky, *scene.background);
    return is_seen ? scene.background : std::nullopt;
}

} // namespace pointrt
