/* SPDX-License-Identifier: MIT
 *
 * group - the name of a group, for messages about missing permission. It reads /etc/group itself: getgrgid()
 * needs the shared C library even in a static program.
 */
#ifndef HAL_GROUP_H
#define HAL_GROUP_H

#include "engine/base/ascii.h"
#include "engine/base/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GROUPS_MOST (1u << 20) /* bytes of /etc/group                           */

/* Whether "gpio:x:993:user" is the line of group @id; cuts it to "gpio". */
static inline bool group_is(char *line, unsigned int id)
{
	char *end = strchr(line, ':'), *at;
	unsigned int number = 0;

	if (!end)
		return false;
	*end = 0;
	at = strchr(end + 1, ':');
	if (!at || !ascii_digit(at[1]))
		return false;
	for (at++; ascii_digit(*at); at++)
		number = number * 10 + (unsigned int)(*at - '0');
	return number == id;
}

/** group_print - "(gpio)": the group with this number; the number, if it has no name. Scan-safe: no. */
static inline void group_print(unsigned int id, char *out, size_t size)
{
	size_t len;
	char *groups = file_read("/etc/group", GROUPS_MOST, &len, NULL);
	char *line = groups, *found = NULL;

	while (line && *line && !found) {
		char *end = strchr(line, '\n');

		if (end)
			*end = '\0';
		found = group_is(line, id) ? line : NULL;
		line = end ? end + 1 : NULL;
	}
	if (found)
		snprintf(out, size, "(%.31s)", found);
	else
		snprintf(out, size, "(%u)", id);
	free(groups);
}
#endif
