// SPDX-License-Identifier: Apache-2.0
// Any hits of the queued rays: what shaders/shadow.comp.glsl traces, without its light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#define ANY_HIT
#include "trace_queued.glsl"
