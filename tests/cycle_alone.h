/* SPDX-License-Identifier: MIT
 *
 * cycle_alone - what cycle.c calls of ladderd, for a program that has it alone: no monitor, no guard, no
 * service manager, no desk. A test adds link_note(), link_serve() and link_show().
 */
#ifndef TESTS_CYCLE_ALONE_H
#define TESTS_CYCLE_ALONE_H

#include "ladderd/control.h"
#include "ladderd/guarded.h"
#include "ladderd/link.h"
#include "tests/unit/rig.h"

bool link_doze(struct link *link, int64_t until_ns)
{
	(void)link, (void)until_ns;
	return false;
}

void link_wake(struct link *link)
{
	(void)link;
}

void requests_attend(struct requests *asked)
{
	(void)asked;
}

void monitor_begin(struct monitor *monitor, int64_t at_ns)
{
	(void)monitor, (void)at_ns;
}

void monitor_end(struct monitor *monitor)
{
	(void)monitor;
}

bool safe_ask(volatile int *ask)
{
	(void)ask;
	return false;
}

void safe_ask_from(int64_t first_ns, int64_t period_ns)
{
	(void)first_ns, (void)period_ns;
}

void notify_send(const struct notify *notify, const char *state)
{
	(void)notify, (void)state;
}

void notify_feed(struct notify *notify, int64_t at_ns)
{
	(void)notify, (void)at_ns;
}

void control_status(const struct cycle *of, bool wait)
{
	(void)of, (void)wait;
}

void control_tell(const char *text)
{
	printf("# %s\n", text);
}

void control_tell_fault(const struct cycle *of)
{
	printf("# fault %d\n", (int)of->resource.fault);
}

void control_tell_halt(const struct cycle *of)
{
	(void)of;
}

void control_trace_values(struct cycle *of)
{
	(void)of;
}

void control_tell_failed(const struct cycle *of)
{
	(void)of;
}
#endif
