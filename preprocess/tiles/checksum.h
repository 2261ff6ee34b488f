// SPDX-License-Identifier: GPL-3.0-or-later
// XXH3 inlined, without linking its library.
#pragma once

#define XXH_INLINE_ALL
#include <xxhash.h>
