// SPDX-License-Identifier: Apache-2.0
// C++20 interface to .pro files on top of pro.h, with spans and exceptions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pointrt/pro.h"

namespace pointrt {

/// Thrown for every pro_result but PRO_OK. what() is "FILE: reason".
struct ProError : std::runtime_error {
    pro_result result; ///< never PRO_OK
    ProError(pro_result why, const std::string& text) : std::runtime_error(text), result(why) {}
};

/// Throws ProError "FILE: text (finding NNNN)" unless result is PRO_OK.
inline void checkPro(pro_result result, const std::string& path, const pro_message& message) {
    if (result == PRO_OK) return;
    std::string text = path + ": " + (message.text[0] ? message.text : pro_result_name(result));
    if (message.finding != 0) text += " (finding " + std::to_string(message.finding) + ")";
    throw ProError(result, text);
}

/// A mapped and validated .pro file, movable but not copyable. Spans are valid during its lifetime.
class ProFile {
public:
    /// Throws ProError if the file cannot be read or has a finding.
    /// @param open_flags PRO_OPEN_*; with PRO_OPEN_TRACE the spans of sections not read are empty
    explicit ProFile(const std::string& path, std::uint32_t open_flags = 0) {
        pro_file* file = nullptr;
        pro_message message{};
        checkPro(pro_open(path.c_str(), open_flags, &file, &message), path, message);
        file_.reset(file);
        pro_get_info(file, &info_);
        pro_get_view(file, &view_);
        has_index_ = pro_get_index(file, &index_) == 1;
        has_gaussians_ = pro_get_gaussians(file, &gaussians_) == 1;
        pro_get_world(file, &world_);
        pro_get_sampling(file, &sampling_);
        attributes_.resize(pro_attribute_count(file));
        for (std::uint32_t i = 0; i < attributes_.size(); ++i) pro_get_attribute(file, i, &attributes_[i]);
    }

    const pro_info& info() const { return info_; }
    const pro_view& view() const { return view_; }

    std::span<const std::uint32_t> nodes() const { return {view_.nodes, view_.nodes ? info_.node_count : 0}; }
    /// PRO_LEAF_WORDS per leaf.
    std::span<const std::uint32_t> leaves() const {
        return {view_.leaves, view_.leaves ? std::size_t{info_.leaf_count} * PRO_LEAF_WORDS : 0};
    }
    std::span<const std::uint32_t> refs() const { return {view_.refs, view_.refs ? info_.ref_count : 0}; }
    /// PRO_SPLAT_WORDS per splat.
    std::span<const std::uint32_t> splats() const {
        return {view_.splats, std::size_t{info_.splat_count} * PRO_SPLAT_WORDS};
    }
    /// PRO_MATERIAL_FLOATS per row.
    std::span<const float> materials() const {
        return {view_.materials, std::size_t{info_.material_count} * PRO_MATERIAL_FLOATS};
    }
    /// Input index of each splat; empty if the file has none.
    std::span<const std::uint32_t> order() const { return {view_.order, view_.order ? info_.splat_count : 0}; }
    /// UTF-8 JSON, or empty.
    std::string_view metadata() const { return {view_.metadata, view_.metadata_bytes}; }
    /// The tracing index; nullptr if the file has none.
    const pro_index* index() const { return has_index_ ? &index_ : nullptr; }
    /// The Gaussians of the splats; nullptr if the file has none.
    const pro_gaussians* gaussians() const { return has_gaussians_ ? &gaussians_ : nullptr; }
    /// The frame of the scan in the world; unknown values are 0.
    const pro_world& world() const { return world_; }
    /// How the splats were made from the points of the input; unknown values are 0.
    const pro_sampling& sampling() const { return sampling_; }
    /// Noise of each splat in steps of its radius / PRO_NOISE_STEPS; empty if the scan is clean.
    std::span<const std::uint8_t> noise() const { return {sampling_.noise, sampling_.noise ? info_.splat_count : 0}; }
    /// Extra attributes besides position, normal and colour.
    const std::vector<pro_attribute>& attributes() const { return attributes_; }
    /// nullptr if there is no attribute of this name.
    const pro_attribute* attribute(std::string_view name) const {
        for (const pro_attribute& each : attributes_)
            if (name == each.name) return &each;
        return nullptr;
    }
    /// All bytes of the file, page aligned.
    std::span<const std::byte> bytes() const {
        std::size_t size = 0;
        const void* data = pro_bytes(file_.get(), &size);
        return {static_cast<const std::byte*>(data), size};
    }

    /// A splat in cube units; see position and radius for input units. @param index below info().splat_count
    pro_splat splat(std::size_t index) const {
        pro_splat result;
        pro_splat_decode(view_.splats + index * PRO_SPLAT_WORDS, info_.radius_max, info_.radius_step, &result);
        return result;
    }
    /// Whether a splat is a ball; its normal has no meaning then. @param index below info().splat_count
    bool isBall(std::size_t index) const { return pro_splat_is_ball(view_.splats + index * PRO_SPLAT_WORDS) != 0; }
    /// The Gaussian of a splat in cube units. The file must have Gaussians. @param index below info().splat_count
    pro_gaussian gaussian(std::size_t index) const {
        pro_gaussian result;
        pro_gaussian_at(&gaussians_, view_.splats, static_cast<std::uint32_t>(index), &result);
        return result;
    }
    /// The codes of a Gaussian's view-dependent colour; empty if the degree is 0.
    std::span<const std::int8_t> harmonics(std::size_t index) const {
        const std::size_t count = std::size_t{3} * pro_harmonic_count(gaussians_.degree);
        return {gaussians_.harmonics + (count > 0 ? index * count : 0), count};
    }
    /// The centre of a splat of this file in input coordinates.
    std::array<double, 3> position(const pro_splat& splat) const {
        std::array<double, 3> at{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            at[axis] = info_.origin[axis] + info_.scale * double{splat.position[axis]};
        return at;
    }
    /// The radius of a splat of this file in input units.
    double radius(const pro_splat& splat) const { return info_.scale * double{splat.radius}; }

private:
    struct Close {
        void operator()(pro_file* file) const { pro_close(file); }
    };
    std::unique_ptr<pro_file, Close> file_;
    pro_info info_{};
    pro_view view_{};
    pro_index index_{};
    bool has_index_ = false;
    pro_gaussians gaussians_{};
    bool has_gaussians_ = false;
    pro_world world_{};
    pro_sampling sampling_{};
    std::vector<pro_attribute> attributes_;
};

/// pro_write_indexed; throws ProError "FILE: reason".
/// @param index may be null
inline void writePro(const std::string& path, const pro_info& info, const pro_view& view,
                     const pro_index* index = nullptr) {
    pro_message message{};
    checkPro(pro_write_indexed(path.c_str(), &info, &view, index, &message), path, message);
}

} // namespace pointrt
