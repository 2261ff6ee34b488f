// SPDX-License-Identifier: GPL-3.0-or-later
// oneTBB's values per thread. On Windows, oneTBB's header includes windows.h, whose macros near and far would erase
// variables with these names in this source and in later ones of its batch.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#undef near
#undef far
