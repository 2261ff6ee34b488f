// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the values of a PLY file in order, in any of its three encodings.
#pragma once

#include "preprocess/ingest/text.h"
#include "preprocess/ingest/typed_word.h"
#include "preprocess/input/mesh/ply_header.h"

namespace pointrt {

/// Values as text.
struct PlyWords {
    const char* at;
    const char* end;

    bool next(Scalar, double& value) {
        skipSpace();
        const char* const stop = at < end ? parseNumber(at, end, value) : nullptr;
        if (!stop || (stop < end && !isSpace(*stop))) return false;
        at = stop;
        return true;
    }

    bool nextAs(Scalar type, char* into, bool& exact) {
        skipSpace();
        const char* stop = at;
        while (stop < end && !isSpace(*stop)) ++stop;
        const Stored stored = storeWord({at, static_cast<std::size_t>(stop - at)}, type, into);
        if (stored == Stored::kNothing) return false;
        exact = exact && stored == Stored::kExactly;
        at = stop;
        return true;
    }

    void skipSpace() {
        while (at < end && isSpace(*at)) ++at;
    }
};

/// Binary values.
struct PlyBytes {
    const char* at;
    const char* end;
    bool swap_bytes;

    bool has(Scalar type) {
        if (static_cast<std::size_t>(end - at) >= scalarSize(type)) return true;
        at = end; // the data is truncated
        return false;
    }

    bool next(Scalar type, double& value) {
        if (!has(type)) return false;
        value = loadScalar(at, type, swap_bytes);
        at += scalarSize(type);
        return true;
    }

    bool nextAs(Scalar type, char* into, bool&) {
        if (!has(type)) return false;
        storeBytes(at, type, swap_bytes, into);
        at += scalarSize(type);
        return true;
    }
};

/// Thrown at the end of a truncated file that is salvaged.
struct PlyEnd {};

/// Reads elements. Throws Error for a missing or malformed value.
template <typename Values>
struct PlyBody {
    const InputFile& input;
    Values values;
    bool salvages = false;
    bool exact = true; ///< all words so far were representable in their types

    void value(const PlyElement& element, std::uint64_t index, Scalar type, double& into) {
        if (!values.next(type, into)) refuseValue(element, index);
    }

    void valueAs(const PlyElement& element, std::uint64_t index, Scalar type, char* into) {
        if (!values.nextAs(type, into, exact)) refuseValue(element, index);
    }

    std::uint64_t listLength(const PlyElement& element, std::uint64_t index, const PlyProperty& property) {
        double length = 0;
        value(element, index, property.count_type, length);
        if (salvages && length > static_cast<double>(values.end - values.at)) throw PlyEnd();
        if (!(length >= 0 && length <= static_cast<double>(values.end - values.at)))
            refuseAt(input, fmt::format("{} {}", element.name, index),
                     fmt::format("impossible list length {}", length));
        return static_cast<std::uint64_t>(length);
    }

    void skip(const PlyElement& element, std::uint64_t index, const PlyProperty& property) {
        double ignored = 0;
        const std::uint64_t count = property.is_list ? listLength(element, index, property) : 1;
        for (std::uint64_t i = 0; i < count; ++i) value(element, index, property.type, ignored);
    }

    void skipElement(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties) skip(element, i, property);
    }

    [[noreturn]] void refuseValue(const PlyElement& element, std::uint64_t done) {
        if (values.at == input.end() && salvages) throw PlyEnd();
        if (values.at == input.end())
            refuse(input, fmt::format("truncated: found {} of {} {}{}", done, element.count, pluralOf(element),
                                      done > 0 ? "; --salvage reads the intact part" : ""));
        std::string_view rest(values.at, static_cast<std::size_t>(input.end() - values.at));
        refuseLine(input, values.at, fmt::format("{} is not a number", inQuotes(nextWord(rest))));
    }
};

/// Calls use with a PlyBody positioned at the first value.
template <typename Use>
void withPlyBody(const InputFile& input, const PlyHeader& header, const Use& use, bool salvages = false) {
    if (header.encoding == PlyEncoding::kAscii)
        use(PlyBody<PlyWords>{input, {header.body, input.end()}, salvages});
    else
        use(PlyBody<PlyBytes>{input, {header.body, input.end(), header.encoding == PlyEncoding::kBigEndian}, salvages});
}

} // namespace pointrt
