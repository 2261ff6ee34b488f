// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/panorama_metadata.h"

namespace pointrt {

std::string panoramaXmp(PixelSize size) {
    const auto property = [](const char* name, const std::string& value) {
        return " GPano:" + std::string(name) + "=\"" + value + "\"";
    };
    const std::string width = std::to_string(size.width), height = std::to_string(size.height);
    return "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>" // begins every XMP packet
           "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
           "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
           "<rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"" +
           property("UsePanoramaViewer", "True") + property("ProjectionType", "equirectangular") +
           property("FullPanoWidthPixels", width) + property("FullPanoHeightPixels", height) +
           property("CroppedAreaImageWidthPixels", width) + property("CroppedAreaImageHeightPixels", height) +
           property("CroppedAreaLeftPixels", "0") + property("CroppedAreaTopPixels", "0") +
           "/></rdf:RDF></x:xmpmeta><?xpacket end=\"r\"?>";
}

} // namespace pointrt
