// SPDX-License-Identifier: GPL-3.0-or-later
// XXH3 in every source that wants it, without its library.
#pragma once

#define XXH_INLINE_ALL
#include <xxhash.h>
