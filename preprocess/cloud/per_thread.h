// SPDX-License-Identifier: GPL-3.0-or-later
// oneTBB's values per thread. On Windows, oneTBB's header includes windows.h, which defines near and far as nothing, in
// this source and in those after it in a batch.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#undef near
#undef far
