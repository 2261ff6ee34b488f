// SPDX-License-Identifier: Apache-2.0
// Ray casting: intersects batches of rays with .pro files, tile sets and scene files on any Vulkan device, including
// the CPU with llvmpipe.
//
//   pointrt::TraceDevice device;
//   pointrt::TraceScene scene(device, {"scan.pro"});               // or tile sets (.proset), or scene files (.toml)
//   std::vector<double> rays{500010, 4500020, 300,  0, 0, -1};   // origin, direction; and so on
//   std::vector<double> t(1);
//   scene.castRays(std::span<const double>(rays), {}, {.t_hit = t});
//
// Rays hit the scan's unblended discs; the nearest hit is the one that pictures shade. Gaussians are hit where they
// have absorbed half of the light; splat_ids then has the Gaussian that contributes most up to there. All classes are
// thread-safe, except that an object in use must not be moved or destroyed. Everything throws TraceError or
// std::bad_alloc.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace pointrt {

/// The splat or instance id of a miss.
constexpr std::uint32_t kNoHit = 4294967295u;

/// The instance id of a hit on a shape of a scene file.
constexpr std::uint32_t kShapesInstance = 255;

/// An error; what() is one line, "FILE: reason" for errors in files.
struct TraceError : std::runtime_error {
    enum class Kind {
        kBadInput = 1,  ///< a file or a ray is invalid
        kBadUsage = 2,  ///< invalid arguments: arrays of the wrong size, limits out of range
        kCannotRun = 3, ///< unsupported on this machine: no device, out of memory, device lost
    };
    Kind kind;
    TraceError(Kind which, const std::string& message) : std::runtime_error(message), kind(which) {}
};

/// kBadInput if a ray is invalid (not finite, or zero direction). what() has the number of the ray and the reason.
struct RayError : TraceError {
    std::uint64_t ray;  ///< the ray's index, from 0
    std::string reason; ///< what() without the index
    RayError(std::uint64_t number, const std::string& why)
        : TraceError(Kind::kBadInput, "ray " + std::to_string(number) + ": " + why), ray(number), reason(why) {}
};

/// Rays as an array [N][6]: origin x y z and direction x y z, in the coordinates of the scan or of the scene file.
/// Directions may have any length but 0. Use doubles for large coordinates, such as national grids.
struct RayRows {
    /// Throws kBadUsage if the size is not a multiple of 6.
    RayRows(std::span<const double> numbers) : doubles(numbers.data()), count(rowsOf(numbers.size())) {}
    RayRows(std::span<const float> numbers) : floats(numbers.data()), count(rowsOf(numbers.size())) {}

    const double* doubles = nullptr; ///< one of the two pointers is null
    const float* floats = nullptr;
    std::size_t count = 0;

private:
    static std::size_t rowsOf(std::size_t numbers) {
        if (numbers % 6 != 0)
            throw TraceError(TraceError::Kind::kBadUsage,
                             "rays have six numbers each, but the array has " + std::to_string(numbers));
        return numbers / 6;
    }
};

/// The valid range of hit distances, in lengths of the direction: t_min <= t < t_max, with 0 <= t_min <= t_max.
/// Disc positions relative to a limit are accurate to a hundredth of the disc's radius.
struct RayLimits {
    double t_min = 0;
    double t_max = std::numeric_limits<double>::infinity();
};

/// Output arrays of castRays, a row per ray. Leave arrays that are not needed empty; any other size than [N] throws
/// kBadUsage.
struct HitArrays {
    std::span<double> t_hit = {};               ///< [N], lengths of the direction; +infinity for a miss
    std::span<std::uint32_t> splat_ids = {};    ///< [N], index in the file or tile; kNoHit for a miss or a shape
    std::span<std::uint32_t> instance_ids = {}; ///< [N], index in the scene, from 0; kNoHit for a miss
    std::span<float> normals = {};              ///< [N][3], of the disc, unit length, towards the origin; 0 for a miss
    std::span<double> positions = {};           ///< [N][3], in the rays' coordinates; NaN for a miss
    std::span<std::uint32_t> tile_ids = {};     ///< [N], index in `tiles` of set.json; kNoHit unless a set is hit
};

/// Options for loading a scene.
struct SceneOptions {
    /// Memory limit in bytes for the tiles of tile sets, on the host and on the device; default 2 GiB. On a device with
    /// dedicated memory, tiles use at most three quarters of it. If the tiles do not all fit, they are loaded and
    /// evicted as rays need them; the hits are the same.
    std::uint64_t memory = std::uint64_t{2} << 30;
    /// Boxes MINX, MINY, MINZ, MAXX, MAXY, MAXZ in the coordinates of the scene, each minimum below its maximum. Rays
    /// hit only what is inside all of them and inside the clips of the scene file, except shapes, which stay whole. At
    /// most 32 planes in total; a box counts as six.
    std::vector<std::array<double, 6>> clips = {};
    /// "NAME=VALUE,VALUE" or "NAME=FROM:TO": rays hit only splats whose attribute (or height) has one of these values.
    /// All of these filters and those of the scene file apply. Scans without the attribute, and Gaussians, are not
    /// filtered.
    std::vector<std::string> filters = {};
};

/// A per-splat attribute that all files of a scene have.
struct SceneAttribute {
    std::string name;
    std::uint32_t type = 0;       ///< PRO_TYPE_* of pointrt/pro_layout.h
    std::uint32_t components = 1; ///< 1 to 4
    std::size_t bytes = 0;        ///< per splat
    double low = 0, high = 0;     ///< range of the finite values; both 0 if no value is finite
};

/// A Vulkan device. It stays alive until its last scene is destroyed.
class TraceDevice {
public:
    /// @param selector "" for the best device, an index in the output of pointrt-view --device list, or part of a name,
    ///        case-insensitive
    /// Throws kCannotRun with a line that names each device and the reason why it is unsuitable.
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

/// A box in the coordinates of the scene.
struct SceneBounds {
    std::array<double, 3> low{}, high{};
};

/// Scans in their own coordinates, or placed by a scene file, loaded for ray casting.
class TraceScene {
public:
    /// Maps files and uploads them to the device. Each path is one of
    ///  - a .pro file, or a tile set (NAME.proset): one more instance, in its own coordinates. Rays intersect the
    ///    finest tiles of a set, each clipped to its core;
    ///  - a scene file (NAME.toml, docs/SCENES.md): its instances in order, placed as it says, in its coordinates. Rays
    ///    also hit its shapes, except backdrops and those hidden from the camera: as the instance kShapesInstance,
    ///    without splat_ids, as in pictures. Materials, lights, cameras and rooms are ignored.
    /// Files must not be modified in place while the scene exists. Throws kBadUsage if paths is empty, for
    /// invalid clips, or if a single tile exceeds options.memory, kBadInput "FILE: reason" for unreadable files and
    /// other formats, kCannotRun if the device has too little memory.
    TraceScene(const TraceDevice& device, const std::vector<std::string>& paths, const SceneOptions& options = {});
    ~TraceScene();
    TraceScene(TraceScene&&) noexcept;
    TraceScene& operator=(TraceScene&&) noexcept;

    /// Finds the first hit of each ray. Any number of rays is traced in chunks, in buffers of some tens of MiB that the
    /// scene keeps. While tiles are loaded and evicted, concurrent calls run one after the other. Throws RayError for
    /// an invalid ray (the arrays are undefined then), kBadUsage for invalid limits and arrays, kBadInput for an
    /// unreadable tile, kCannotRun if the device is lost.
    void castRays(RayRows rays, const RayLimits& limits, const HitArrays& hits) const;

    /// Tests whether each ray hits anything: 1 or 0 [N]. Faster than castRays. Throws as castRays.
    void testOcclusions(RayRows rays, const RayLimits& limits, std::span<std::uint8_t> occluded) const;

    /// The attributes that all files and sets have, in the order of the first one.
    std::vector<SceneAttribute> attributes() const;
    /// Reads an attribute of the splats that castRays has hit, attribute.bytes each. Misses and shapes get 0, or NaN
    /// for floats. tile_ids may be empty if the scene has no sets. Throws kBadUsage for an unknown name or unequal
    /// sizes.
    void readAttribute(const std::string& name, std::span<const std::uint32_t> splat_ids,
                       std::span<const std::uint32_t> instance_ids, std::span<const std::uint32_t> tile_ids,
                       std::span<std::byte> values) const;
    /// The same for a scene without sets.
    void readAttribute(const std::string& name, std::span<const std::uint32_t> splat_ids,
                       std::span<const std::uint32_t> instance_ids, std::span<std::byte> values) const;
    /// Reads the colours of the splats that castRays has hit: sRGB bytes [N][3], 0 for misses and shapes, white for
    /// scans without colours. tile_ids may be empty if the scene has no sets. Throws kBadUsage for unequal sizes.
    void readColors(std::span<const std::uint32_t> splat_ids, std::span<const std::uint32_t> instance_ids,
                    std::span<const std::uint32_t> tile_ids, std::span<std::uint8_t> colors) const;
    /// The same for a scene without sets.
    void readColors(std::span<const std::uint32_t> splat_ids, std::span<const std::uint32_t> instance_ids,
                    std::span<std::uint8_t> colors) const;

    /// A box around all splats including the extent of their discs; empty, at 0, if the scene has only shapes.
    SceneBounds bounds() const;
    /// Metres per unit of the scans' coordinates; 0 if unknown, or if the scans differ.
    double metresPerUnit() const;
    /// The number of splats of all instances; for sets, those of the finest level, each once.
    std::uint64_t splatCount() const;
    std::size_t instanceCount() const;
    /// True if any instance is a tile set.
    bool hasTiles() const;
    /// The number of tile uploads to the device since the scene was opened, including reloads.
    std::uint64_t tileLoads() const;
    /// The device memory of the scene at present, without rays in flight.
    std::uint64_t deviceBytes() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

} // namespace pointrt
