// SPDX-License-Identifier: Apache-2.0
// Rays against scans: batches of them through .pro files, tile sets and scene files, on any Vulkan device, llvmpipe on
// plain processors included.
//
//   pointrt::TraceDevice device;
//   pointrt::TraceScene scene(device, {"scan.pro"});               // or tile sets (.proset), or scene files (.toml)
//   std::vector<double> rays{500010, 4500020, 300,  0, 0, -1};   // origin, direction; and so on
//   std::vector<double> t(1);
//   scene.castRays(std::span<const double>(rays), {}, {.t_hit = t});
//
// What is hit is the scan's discs as they lie there, the nearest first: the hits that pictures begin with.
// All of it may be used from several threads at once, but for moving and destroying what others use. Everything throws
// TraceError or std::bad_alloc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace pointrt {

/// In place of a splat's or an instance's number where nothing is hit.
constexpr std::uint32_t kNoHit = 4294967295u;

/// In place of an instance's number where a scene file's own shape is hit.
constexpr std::uint32_t kShapesInstance = 255;

/// What went wrong; what() is one line, "FILE: reason" where it is about a file.
struct TraceError : std::runtime_error {
    enum class Kind {
        kBadInput = 1,  ///< a file, or a ray, is wrong
        kBadUsage = 2,  ///< a caller's bug: arrays of the wrong size, limits that are none
        kCannotRun = 3, ///< this machine cannot: no device, out of its memory, lost
    };
    Kind kind;
    TraceError(Kind which, const std::string& message) : std::runtime_error(message), kind(which) {}
};

/// kBadInput for a ray that is none. what() has the ray and the reason.
struct RayError : TraceError {
    std::uint64_t ray;  ///< from 0, of those that were given
    std::string reason; ///< without it
    RayError(std::uint64_t number, const std::string& why)
        : TraceError(Kind::kBadInput, "ray " + std::to_string(number) + ": " + why), ray(number), reason(why) {}
};

/// Rays, six numbers each, one behind the other: origin x y z and direction x y z, in the scan's own coordinates, or
/// those of the scene file.
/// Directions may have any length but 0. In doubles national grids lose nothing.
struct RayRows {
    /// Throws kBadUsage where the numbers do not come to whole rays.
    RayRows(std::span<const double> numbers) : doubles(numbers.data()), count(rowsOf(numbers.size())) {}
    RayRows(std::span<const float> numbers) : floats(numbers.data()), count(rowsOf(numbers.size())) {}

    const double* doubles = nullptr; ///< one of the two is null
    const float* floats = nullptr;
    std::size_t count = 0;

private:
    static std::size_t rowsOf(std::size_t numbers) {
        if (numbers % 6 != 0)
            throw TraceError(TraceError::Kind::kBadUsage,
                             "rays have six numbers each, and " + std::to_string(numbers) + " are no multiple of that");
        return numbers / 6;
    }
};

/// What of each ray counts, in lengths of its direction: hits from t_min on and before t_max; 0 <= t_min <= t_max.
/// Discs beside a limit are told by where they are to a hundredth of their radius.
struct RayLimits {
    double t_min = 0;
    double t_max = std::numeric_limits<double>::infinity();
};

/// Where hits are put, a row for each ray, in their order. What is left empty is not asked for; else the sizes must be
/// right, or it is kBadUsage.
struct HitArrays {
    std::span<double> t_hit = {};            ///< [N], lengths of the direction; +infinity for a miss
    std::span<std::uint32_t> splat_ids = {}; ///< [N], as the file, or tile, numbers them; kNoHit for a miss or a shape
    std::span<std::uint32_t> instance_ids = {}; ///< [N], of the scene's instances, from 0; kNoHit for a miss
    std::span<float> normals = {};              ///< [N][3], of the disc, unit length, towards the origin; 0 for a miss
    std::span<double> positions = {};           ///< [N][3], the rays' coordinates; NaN for a miss
    std::span<std::uint32_t> tile_ids = {};     ///< [N], in `tiles` of set.json, from 0; kNoHit but for hits of sets
};

/// How a scene is held.
struct SceneOptions {
    /// Bytes that the tiles of its sets may take at once, in files and on the device: 2 GiB. On a device with memory of
    /// its own it is no more than three quarters of that. With less than all of them take, tiles come and go as rays
    /// need them; hits are the same.
    std::uint64_t memory = std::uint64_t{2} << 30;
};

/// A number, or a few, that all files of a scene have for each splat.
struct SceneAttribute {
    std::string name;
    std::uint32_t type = 0;       ///< PRO_TYPE_* of pointrt/pro_layout.h
    std::uint32_t components = 1; ///< 1 to 4
    std::size_t bytes = 0;        ///< of a splat's
    double low = 0, high = 0;     ///< of all finite numbers; both 0 where there is none
};

/// A Vulkan device. It lives until the last scene on it is gone.
class TraceDevice {
public:
    /// @param selector "" for the best one, else an index of the list that pointrt-view --device list prints, or a
    ///        part of a name in any case
    /// Throws kCannotRun with a line that names each device and why it was refused.
    explicit TraceDevice(const std::string& selector = "");
    ~TraceDevice();
    TraceDevice(TraceDevice&&) noexcept;
    TraceDevice& operator=(TraceDevice&&) noexcept;

    const std::string& name() const;

    struct State;

private:
    friend class TraceScene;
    friend class PictureRenderer;
    std::shared_ptr<State> state_;
};

/// Scans that stand where their own coordinates put them, or where a scene file does, ready for rays.
class TraceScene {
public:
    /// Maps files and puts them on the device. Each path is one of
    ///  - a .pro file, or a tile set (NAME.proset): the next instance, where its coordinates put it. Of a set its
    ///    original tiles are asked, each for what lies in its core;
    ///  - a scene file (NAME.toml, docs/SCENES.md): its instances in their order, where it puts them, in its
    ///    coordinates. Its shapes are hit as well, but for those that cameras do not see and backdrops: as the
    ///    instance kShapesInstance, without splat_ids, as pictures have it. Materials, lights, cameras and rooms mean
    ///    nothing.
    /// Files must not be written in place meanwhile. Throws kBadUsage without paths, or where a tile takes more than
    /// options.memory, kBadInput "FILE: reason" for what cannot be read or is none of these, kCannotRun where the
    /// device is too small.
    TraceScene(const TraceDevice& device, const std::vector<std::string>& paths, const SceneOptions& options = {});
    ~TraceScene();
    TraceScene(TraceScene&&) noexcept;
    TraceScene& operator=(TraceScene&&) noexcept;

    /// The first hit of each ray. Any number of rays: they go to the device in chunks, in a memory of some tens of MiB
    /// that stays with the scene. Where tiles come and go, calls take turns. Throws RayError for the first ray that it
    /// met which is no ray (the arrays are undefined then), kBadUsage for limits and arrays that are none, kBadInput
    /// for a tile that cannot be read, kCannotRun for a lost device.
    void castRays(RayRows rays, const RayLimits& limits, const HitArrays& hits) const;

    /// Whether anything at all stands in each ray's way: 1 or 0 [N]. Sooner done than a first hit. Throws the same.
    void testOcclusions(RayRows rays, const RayLimits& limits, std::span<std::uint8_t> occluded) const;

    /// What all files and sets have for their splats, in the first one's order.
    std::vector<SceneAttribute> attributes() const;
    /// The attribute's numbers for the splats of hits, as castRays tells them: attribute.bytes each. Misses get zeros,
    /// floats NaN; so do shapes. tile_ids may be empty where the scene has no sets. Throws kBadUsage where the scene
    /// has none of that name, or sizes differ.
    void readAttribute(const std::string& name, std::span<const std::uint32_t> splat_ids,
                       std::span<const std::uint32_t> instance_ids, std::span<const std::uint32_t> tile_ids,
                       std::span<std::byte> values) const;
    /// Of a scene without sets.
    void readAttribute(const std::string& name, std::span<const std::uint32_t> splat_ids,
                       std::span<const std::uint32_t> instance_ids, std::span<std::byte> values) const;
    /// Colours of the splats of hits, as castRays tells them: sRGB bytes [N][3], 0 for misses and shapes; those of a
    /// scan without colours are white. tile_ids may be empty where the scene has no sets. Throws kBadUsage where sizes
    /// differ.
    void readColors(std::span<const std::uint32_t> splat_ids, std::span<const std::uint32_t> instance_ids,
                    std::span<const std::uint32_t> tile_ids, std::span<std::uint8_t> colors) const;
    /// Of a scene without sets.
    void readColors(std::span<const std::uint32_t> splat_ids, std::span<const std::uint32_t> instance_ids,
                    std::span<std::uint8_t> colors) const;

    /// How long a unit of the scans' coordinates is; 0 where they do not say, or differ.
    double metresPerUnit() const;
    /// Of all instances; of sets the original ones, once.
    std::uint64_t splatCount() const;
    std::size_t instanceCount() const;
    /// Whether any instance is a tile set.
    bool hasTiles() const;
    /// How many tiles were put on the device since the scene was opened, each time counted.
    std::uint64_t tileLoads() const;
    /// Of what the scene takes on the device now, without rays under way.
    std::uint64_t deviceBytes() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

} // namespace pointrt
