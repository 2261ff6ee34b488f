// SPDX-License-Identifier: GPL-3.0-or-later
// Draco's decoders with additional checks. Without these, they convert any byte of the file to a
// PredictionSchemeMethod, which is undefined for values outside the enumeration, and allocate memory for a second,
// unchecked number of points.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <draco/compression/attributes/kd_tree_attributes_decoder.h>
#include <draco/compression/attributes/sequential_attribute_decoders_controller.h>
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/point_cloud/point_cloud_kd_tree_decoder.h>

namespace pointrt {

using DracoController = draco::SequentialAttributeDecodersController;

/// Accesses private members of a controller: the point sequencer that it was made with and its point ids. (An explicit
/// instantiation may name private members.)
std::unique_ptr<draco::PointsSequencer>& sequencerOf(DracoController& controller);
std::vector<draco::PointIndex>& pointsOf(DracoController& controller);
template <auto sequencer, auto points>
struct ControllerAccess {
    friend std::unique_ptr<draco::PointsSequencer>& sequencerOf(DracoController& controller) {
        return controller.*sequencer;
    }
    friend std::vector<draco::PointIndex>& pointsOf(DracoController& controller) { return controller.*points; }
};
template struct ControllerAccess<&DracoController::sequencer_, &DracoController::point_ids_>;

/// Decodes attributes one after the other as its base class does, but first checks the byte with which each begins.
class GuardedController : public DracoController {
public:
    using DracoController::DracoController;

protected:
    std::unique_ptr<draco::SequentialAttributeDecoder> CreateSequentialDecoder(std::uint8_t type) override {
        auto decoder = DracoController::CreateSequentialDecoder(type);
        decoders_.push_back({decoder.get(), type != draco::SEQUENTIAL_ATTRIBUTE_ENCODER_GENERIC});
        return decoder;
    }

    bool DecodePortableAttributes(draco::DecoderBuffer* buffer) override {
        for (const Each& each : decoders_) {
            std::int8_t method = 0;
            if (each.predicts &&
                !(buffer->Peek(&method) && method >= draco::PREDICTION_NONE && method < draco::NUM_PREDICTION_SCHEMES))
                return false;
            if (!each.decoder->DecodePortableAttribute(pointsOf(*this), buffer)) return false;
        }
        return true;
    }

private:
    struct Each {
        draco::SequentialAttributeDecoder* decoder;
        bool predicts; ///< the data begins with its prediction method
    };
    std::vector<Each> decoders_; ///< in the order of the attributes
};

/// Decodes a k-d tree of points as its base class does. Before version 2.3, a method, a level and the number of points
/// precede the tree; the base class trusts that number, whatever the header says.
class GuardedKdTree : public draco::KdTreeAttributesDecoder {
protected:
    bool DecodeDataNeededByPortableTransforms(draco::DecoderBuffer* buffer) override {
        if (buffer->bitstream_version() < DRACO_BITSTREAM_VERSION(2, 3)) {
            std::uint32_t points = 0;
            std::array<char, 2 + sizeof points> start{};
            if (!buffer->Peek(start.data(), start.size())) return false;
            std::memcpy(&points, start.data() + 2, sizeof points);
            if (points == 0 || points != GetDecoder()->point_cloud()->num_points()) return false;
        }
        return KdTreeAttributesDecoder::DecodeDataNeededByPortableTransforms(buffer);
    }
};

/// A file decoder with these checks.
template <typename Decoder>
class GuardedAttributes : public Decoder {
protected:
    bool CreateAttributesDecoder(std::int32_t id) override {
        if constexpr (std::is_same_v<Decoder, draco::PointCloudKdTreeDecoder>)
            return this->SetAttributesDecoder(id, std::make_unique<GuardedKdTree>());
        if (!Decoder::CreateAttributesDecoder(id)) return false;
        auto& made = const_cast<DracoController&>(static_cast<const DracoController&>(*this->attributes_decoder(id)));
        return this->SetAttributesDecoder(id, std::make_unique<GuardedController>(std::move(sequencerOf(made))));
    }
};

} // namespace pointrt
