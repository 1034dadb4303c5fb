/* SPDX-License-Identifier: MIT
 *
 * sim_seen - the simulation of a window, found by its signal.
 */
#ifndef TESTS_EDITOR_SIM_SEEN_H
#define TESTS_EDITOR_SIM_SEEN_H

#include "editor-gtk/sim/sim.h"

static LadderSim *sim_seen; /* whose state changed last since sim_watch(); NULL: none */

static inline gboolean sim_see(GSignalInvocationHint *hint, guint count, const GValue *values, gpointer unused)
{
	(void)hint, (void)count, (void)unused;
	sim_seen = g_value_get_object(values);
	return TRUE;
}

/** sim_watch - from now on. */
static inline void sim_watch(void)
{
	g_type_class_ref(LADDER_TYPE_SIM);
	g_signal_add_emission_hook(g_signal_lookup("state-changed", LADDER_TYPE_SIM), 0, sim_see, NULL, NULL);
}

#endif
