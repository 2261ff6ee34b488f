// SPDX-License-Identifier: GPL-3.0-or-later
// GeoTIFF: heights of square cells in a coordinate system (OGC GeoTIFF Standard 1.1).
#include <cmath>
#include <utility>

#include "format/pointio/las_crs.h"
#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"
#include "preprocess/ingest/unpack_limit.h"
#include "preprocess/input/points/height_grid.h"
#include "preprocess/input/points/tiff_file.h"

namespace pointrt {
namespace {

enum GeoTag : std::uint32_t {
    kPixelScale = 33550,
    kTiePoint = 33922,
    kModelTransform = 34264,
    kGeoKeyDirectory = 34735,
    kGeoDoubles = 34736,
    kGdalNoData = 42113
};

struct HeightImage {
    std::uint32_t columns = 0, rows = 0, samples = 1;
    Scalar type = Scalar::kF32;
    Eigen::Affine2d place = Eigen::Affine2d::Identity(); ///< input coordinates of pixels, centres at whole numbers
    bool is_placed = false;
    std::optional<double> no_data;
    LasCrs crs;
};

std::optional<Scalar> sampleType(std::uint32_t format, std::uint32_t bits) {
    if (format == SAMPLEFORMAT_IEEEFP && bits == 32) return Scalar::kF32;
    if (format == SAMPLEFORMAT_IEEEFP && bits == 64) return Scalar::kF64;
    const bool has_sign = format == SAMPLEFORMAT_INT;
    if (!has_sign && format != SAMPLEFORMAT_UINT && format != SAMPLEFORMAT_VOID) return std::nullopt;
    if (bits == 8) return has_sign ? Scalar::kI8 : Scalar::kU8;
    if (bits == 16) return has_sign ? Scalar::kI16 : Scalar::kU16;
    if (bits == 32) return has_sign ? Scalar::kI32 : Scalar::kU32;
    return std::nullopt;
}

/// Whether pixels are points at whole numbers of the raster space; otherwise they are areas, whose corners are there.
bool arePoints(const std::vector<std::uint16_t>& keys) {
    constexpr std::uint16_t kRasterType = 1025, kPoint = 2;
    for (std::size_t at = 4; at + 4 <= keys.size(); at += 4)
        if (keys[at] == kRasterType && keys[at + 1] == 0) return keys[at + 3] == kPoint;
    return false;
}

/// Sets the place of pixels from a transform, or from the scale and a tie point: raster i j k, model x y z.
void placePixels(const InputFile& input, const TiffFile& tiff, HeightImage& image) {
    const std::vector<double> transform = tiff.doubles(kModelTransform), scale = tiff.doubles(kPixelScale),
                              tie = tiff.doubles(kTiePoint);
    if (transform.size() == 16) {
        image.place.linear() << transform[0], transform[1], transform[4], transform[5];
        image.place.translation() << transform[3], transform[7];
    } else if (scale.size() >= 2 && tie.size() >= 6) {
        image.place.linear() << scale[0], 0, 0, -scale[1];
        image.place.translation() << tie[3] - scale[0] * tie[0], tie[4] + scale[1] * tie[1];
    } else {
        image.place.linear() << 1, 0, 0, -1; // rows from the north, as pictures have them
        return;
    }
    if (!image.place.matrix().allFinite() || image.place.linear().determinant() == 0)
        refuse(input, "has invalid georeferencing (ModelPixelScale, ModelTiepoint or ModelTransformation)");
    if (!arePoints(tiff.shorts(kGeoKeyDirectory))) image.place.translate(Eigen::Vector2d(0.5, 0.5));
    image.is_placed = true;
}

LasCrs crsOfTiff(const TiffFile& tiff) {
    const std::vector<std::uint16_t> keys = tiff.shorts(kGeoKeyDirectory);
    const std::vector<double> doubles = tiff.doubles(kGeoDoubles);
    return crsOfGeoKeys({reinterpret_cast<const char*>(keys.data()), keys.size() * sizeof(std::uint16_t)},
                        {reinterpret_cast<const char*>(doubles.data()), doubles.size() * sizeof(double)});
}

HeightImage readImageHeader(const InputFile& input, const TiffFile& tiff) {
    HeightImage image;
    image.columns = tiff.number(TIFFTAG_IMAGEWIDTH);
    image.rows = tiff.number(TIFFTAG_IMAGELENGTH);
    image.samples = tiff.number(TIFFTAG_SAMPLESPERPIXEL);
    const std::uint32_t bits = tiff.number(TIFFTAG_BITSPERSAMPLE);
    const auto type = sampleType(tiff.number(TIFFTAG_SAMPLEFORMAT), bits);
    placePixels(input, tiff, image);
    const bool is_picture = bits == 8 && (image.samples > 1 || !image.is_placed);
    if (!type || is_picture || image.samples == 0)
        refuse(input,
               fmt::format("is not a grid of heights: it has {} samples of {} bits in a pixel", image.samples, bits));
    image.type = *type;
    double no_data = 0;
    if (const std::string text = tiff.text(kGdalNoData); wholeNumber(text, no_data)) image.no_data = no_data;
    image.crs = crsOfTiff(tiff);
    // Flat ground compresses a hundredfold; a damaged header must not declare a higher ratio.
    constexpr std::uint64_t kCellsAtLeast = 1 << 22, kCellsPerByte = 100;
    const std::uint64_t cells = std::uint64_t{image.columns} * image.rows;
    if (cells == 0 || cells > kCellsAtLeast + kCellsPerByte * input.bytes.size())
        refuse(input, fmt::format("the header promises {} x {} cells in {} bytes", image.columns, image.rows,
                                  input.bytes.size()));
    return image;
}

/// A strip or tile of the image.
struct ImageBlock {
    std::uint32_t column = 0, row = 0;   ///< of its first pixel
    std::uint32_t columns = 0, rows = 0; ///< within the image
    std::uint32_t width = 0;             ///< pixels from row to row
};

/// Returns the number of cells without data.
std::uint64_t addBlock(const HeightImage& image, const ImageBlock& block, std::uint32_t samples, const char* pixels,
                       Sink& sink) {
    std::uint64_t missing = 0;
    const std::size_t size = scalarSize(image.type) * samples;
    Row row{};
    for (std::uint32_t j = 0; j < block.rows; ++j)
        for (std::uint32_t i = 0; i < block.columns; ++i) {
            row[kZ] = loadScalar(pixels + (std::size_t{j} * block.width + i) * size, image.type, false);
            const bool is_missing =
                image.no_data && (row[kZ] == *image.no_data || (image.type == Scalar::kF32 &&
                                                                row[kZ] == double(static_cast<float>(*image.no_data))));
            if (is_missing || !std::isfinite(row[kZ])) {
                ++missing;
                continue;
            }
            const Eigen::Vector2d at = image.place * Eigen::Vector2d(block.column + i, block.row + j);
            row[kX] = at.x();
            row[kY] = at.y();
            sink.addVertex(row);
        }
    return missing;
}

/// The blocks of the first sample of all pixels, in their order.
std::vector<ImageBlock> blocksOf(const TiffFile& tiff, const HeightImage& image) {
    const bool tiled = TIFFIsTiled(tiff.get()) != 0;
    const std::uint32_t width = tiled ? tiff.number(TIFFTAG_TILEWIDTH) : image.columns,
                        height = std::min(tiled ? tiff.number(TIFFTAG_TILELENGTH) : tiff.number(TIFFTAG_ROWSPERSTRIP),
                                          tiled ? ~std::uint32_t{0} : image.rows);
    if (width == 0 || height == 0) tiff.fail("the size of its strips or tiles");
    std::vector<ImageBlock> blocks;
    for (std::uint64_t row = 0; row < image.rows; row += height)
        for (std::uint64_t column = 0; column < image.columns; column += width)
            blocks.push_back({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row),
                              static_cast<std::uint32_t>(std::min<std::uint64_t>(width, image.columns - column)),
                              static_cast<std::uint32_t>(std::min<std::uint64_t>(height, image.rows - row)), width});
    return blocks;
}

std::uint64_t addCells(const InputFile& input, const TiffFile& tiff, const HeightImage& image, Sink& sink) {
    const bool tiled = TIFFIsTiled(tiff.get()) != 0;
    const tmsize_t size = tiled ? TIFFTileSize(tiff.get()) : TIFFStripSize(tiff.get());
    const bool separate = tiff.number(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    const std::uint32_t samples = separate ? 1 : image.samples;
    if (size <= 0 || static_cast<std::uint64_t>(size) > mostUnpacked(input.bytes.size()))
        tiff.fail("the size of its strips or tiles");
    std::vector<char> pixels(static_cast<std::size_t>(size));
    std::uint64_t missing = 0;
    std::uint32_t index = 0;
    for (const ImageBlock& block : blocksOf(tiff, image)) {
        const tmsize_t read = tiled ? TIFFReadEncodedTile(tiff.get(), index, pixels.data(), size)
                                    : TIFFReadEncodedStrip(tiff.get(), index, pixels.data(), size);
        const std::size_t needed = std::size_t{block.width} * block.rows * samples * scalarSize(image.type);
        if (read < 0 || static_cast<std::size_t>(read) < needed)
            tiff.fail(fmt::format("{} {} of its heights", tiled ? "tile" : "strip", index));
        missing += addBlock(image, block, samples, pixels.data(), sink);
        ++index;
    }
    return missing;
}

bool isTiff(std::string_view bytes) {
    using namespace std::string_view_literals;
    return bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) || bytes.starts_with("II+\0"sv) ||
           bytes.starts_with("MM\0+"sv);
}

void readGeoTiff(const InputFile& input, Sink& sink) {
    const TiffFile tiff(input);
    const HeightImage image = readImageHeader(input, tiff);
    if (!image.is_placed) sink.note(input, "is not georeferenced: its cells are taken to be 1 unit apart");
    if (image.samples > 1) sink.note(input, fmt::format("has {} bands: the first is read as heights", image.samples));
    const std::uint64_t cells = std::uint64_t{image.columns} * image.rows;
    ScanTraits traits;
    traits.faces = false;
    traits.vertices = cells;
    sink.beginScan(input, traits);
    const std::uint64_t missing = addCells(input, tiff, image, sink);
    WorldFrame frame;
    frame.crs = image.crs.name;
    frame.metres_per_unit = image.crs.metres_per_unit;
    finishHeights(input, missing, cells, std::move(frame), sink);
    if (image.crs.kind == LasCrs::Kind::kGeographic) sink.addDegrees(input);
}

} // namespace

const FormatReader readers::kGeoTiff{.isStart = isTiff, .read = readGeoTiff, .readsInBatches = alwaysInBatches};

} // namespace pointrt
