/* SPDX-License-Identifier: MIT
 *
 * test_memory - a program of 1,000 rungs runs in the memory and the stack of a small board.
 */
#define _DEFAULT_SOURCE /* pread() */
#include "tests/targets/guest/panel.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define RSS_KB      2304 /* of which reading a text takes 400: code that an image does not need */
#define STACK_BYTES 8192 /* the whole memory without an MMU                 */
#define SPARE_BYTES 256  /* never touched                                   */
#define LOOK_BYTES  (256 * 1024)

static long about(const struct child *child, const char *file, char *out,
		  size_t room)
{
	char path[64];

	snprintf(path, sizeof(path), "/proc/%d/%s", (int)child->pid, file);
	return file_take(path, out, room);
}

/* N of a line `WORD N` of /proc/PID/status; -1: no such line. */
static long status_number(const struct child *child, const char *word)
{
	static char text[TEXT_BYTES];
	const char *line;

	if (about(child, "status", text, sizeof(text)) <= 0)
		return -1;
	line = strstr(text, word);
	return line ? strtol(line + strlen(word), NULL, 10) : -1;
}

/* Number @at (1-based) of /proc/PID/stat. */
static unsigned long stat_number(const struct child *child, int at)
{
	static char text[1024];
	const char *field;

	if (about(child, "stat", text, sizeof(text)) <= 0)
		return 0;
	field = strrchr(text, ')');
	for (int i = 2; field && i < at; i++)
		field = strchr(field + 1, ' ');
	return field ? strtoul(field + 1, NULL, 10) : 0;
}

/* The mapping that holds @address: its first and its last byte plus 1. */
static bool mapping_of(const struct child *child, unsigned long address,
		       unsigned long *first, unsigned long *end)
{
	static char text[TEXT_BYTES];
	char *line = text, *dash;

	if (about(child, "maps", text, sizeof(text)) <= 0)
		return false;
	for (; line && *line; line = strchr(line, '\n'), line += line != NULL) {
		*first = strtoul(line, &dash, 16);
		if (*dash != '-')
			return false;
		*end = strtoul(dash + 1, NULL, 16);
		if (address >= *first && address < *end)
			return true;
	}
	return false;
}

/* Bytes from the end of the stack down to the lowest one that is not zero. The kernel
 * provides a zeroed stack, and calls leave bytes behind. 0: cannot be read here. */
static unsigned long stack_used(const struct child *child)
{
	static unsigned char bytes[LOOK_BYTES];
	unsigned long begin = stat_number(child, 28), first, end, size, i;
	char path[64];
	ssize_t got;
	int fd;

	if (!begin || !mapping_of(child, begin, &first, &end))
		return 0;
	size = end - first < LOOK_BYTES ? end - first : LOOK_BYTES;
	snprintf(path, sizeof(path), "/proc/%d/mem", (int)child->pid);
	fd = open(path, O_RDONLY);
	got = fd < 0 ? -1 : pread(fd, bytes, size, (off_t)(end - size));
	if (fd >= 0)
		close(fd);
	if (got != (ssize_t)size)
		return 0;
	for (i = 0; i < size && !bytes[i]; i++)
		;
	return size - i;
}

static void look_at_stack(struct child *child)
{
	unsigned long used;

	for (int i = 0; i < 3; i++)
		child_status(child); /* prints, which needs most stack   */
	used = stack_used(child);
	if (!used)
		skip("no /proc/PID/mem here", "stack");
	else if (guest.small)
		check(used + SPARE_BYTES <= STACK_BYTES,
		      "%lu of %d bytes of stack were used", used, STACK_BYTES);
	else
		note("%lu bytes of stack were used, arguments and environment "
		     "included", used);
}

static void run_program(const char *name)
{
	struct child child;
	long rss;

	panel_up(-1);
	ladderd_start(&child, file_case(name), file_text("panel.io", PANEL_PLAIN),
		      NULL);
	if (check(child_ready() != 0, "%s: 1,000 rungs run", name)) {
		bank_pull(&panel, IN0, true);
		check(panel_shows(1), "%s: the first of them works", name);
		rss = status_number(&child, "VmRSS:");
		if (rss < 0)
			note("%s: %ld bytes of memory in all", name,
			     status_number(&child, "Mem:"));
		else
			check(rss <= RSS_KB, "%s: %ld of %d kB resident", name,
			      rss, RSS_KB);
		look_at_stack(&child);
	}
	check(child_stop(&child) == 0, "%s: ends", name);
	panel_down();
}

void test_memory(void)
{
	run_program("thousand.rungc");
	if (guest.small)
		skip("the small ladderd takes images only", "thousand.rung");
	else
		run_program("thousand.rung");
}
