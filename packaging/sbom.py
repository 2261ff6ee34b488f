#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the bill of materials of pointrt as SPDX 2.3 JSON: the packages in .ci/packages.txt that are compiled in or
linked, with the versions installed here, and the crates in format/pointio/Cargo.lock. SOURCE_DATE_EPOCH is its date."""

import json
import os
import re
import subprocess
import sys
import time
import tomllib
from pathlib import Path
from urllib.parse import quote

ROOT = Path(__file__).resolve().parent.parent

# Build tools, which leave no part of themselves in the result.
TOOLS = {"cmake", "ninja-build", "pkg-config", "glslang-tools", "spirv-tools", "ca-certificates",
         "cargo", "cargo-web", "mesa-vulkan-drivers"}
# "bake" in packages.txt means that only pointrt-bake uses the package.
PARTS_OF = {"build": "all tools", "bake": "pointrt-bake", "view": "pointrt-view, pointrt-rays and pointrt::trace",
            "rust12": "pointrt-bake, pointrt-info and pointrt-rays", "rust13": "pointrt-bake, pointrt-info and pointrt-rays"}


def listed_packages():
    """(name, use, what for) of the packages that end up in what is built."""
    for line in (ROOT / ".ci/packages.txt").read_text().splitlines():
        match = re.match(r"(\S+)\s+# (\w+): (.*)", line)
        if match and match[2] in PARTS_OF and match[1] not in TOOLS:
            yield match.groups()


def installed_version(package):
    """The installed version; empty if the package is not installed."""
    query = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True)
    return query.stdout if query.returncode == 0 else ""


def crates():
    """(name, version, SHA-256) of the crates from crates.io."""
    for crate in tomllib.loads((ROOT / "format/pointio/Cargo.lock").read_text())["package"]:
        if "checksum" in crate:
            yield crate["name"], crate["version"], crate["checksum"]


def entry(kind, name, version, url, **more):
    identifier = re.sub(r"[^A-Za-z0-9.-]", "-", f"{kind}-{name}-{version}")
    return {"SPDXID": f"SPDXRef-{identifier}", "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False, "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION",
            "copyrightText": "NOASSERTION",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                              "referenceLocator": url}], **more}


def parts():
    for name, use, purpose in listed_packages():
        if version := installed_version(name):
            yield entry("deb", name, version, f"pkg:deb/debian/{quote(name)}@{quote(version)}",
                        comment=f"In {PARTS_OF[use]}: {purpose}")
    for name, version, checksum in crates():
        yield entry("crate", name, version, f"pkg:cargo/{name}@{version}",
                    checksums=[{"algorithm": "SHA256", "checksumValue": checksum}])


def document():
    version = re.search(r"project\(pointrt VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    own = entry("own", "pointrt", version, f"pkg:generic/pointrt@{version}",
                licenseDeclared="Apache-2.0 AND GPL-3.0-or-later",
                comment="pointrt-bake is GPL-3.0-or-later, all else Apache-2.0")
    packages = [own, *parts()]
    created = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    relations = [{"spdxElementId": own["SPDXID"], "relationshipType": "DEPENDS_ON", "relatedSpdxElement": each["SPDXID"]}
                 for each in packages[1:]]
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"pointrt-{version}", "documentNamespace": f"https://pointrt.invalid/spdx/{version}",
            "creationInfo": {"created": created, "creators": ["Tool: packaging/sbom.py"]},
            "documentDescribes": [own["SPDXID"]], "packages": packages, "relationships": relations}


if __name__ == "__main__":
    json.dump(document(), sys.stdout, indent=2)
    print()
