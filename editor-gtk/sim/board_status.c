/* SPDX-License-Identifier: MIT
 *
 * board_status - what a running ladderd tells of itself, read line by line.
 */
#include "editor-gtk/sim/board_status.h"

#include <stdio.h>
#include <string.h>

/* "last 1.0 us, mean 2.0 us, max 3.0 us": what stands behind @word. */
static void part(char *out, size_t size, const char *text, const char *word)
{
	const char *at = strstr(text, word);
	size_t len;

	if (!at)
		return;
	at += strlen(word);
	len = strcspn(at, ",");
	snprintf(out, size, "%.*s", (int)(len < size ? len : size - 1), at);
}

bool board_status_line(struct board_status *status, const char *line)
{
	const struct { const char *word; char *out; size_t size; } row[] = {
		{ "state: ", status->state, sizeof(status->state) },
		{ "fault: ", status->fault, sizeof(status->fault) },
		{ "stop: ", status->stop, sizeof(status->stop) },
		{ "errors: ", status->errors, sizeof(status->errors) },
		{ "scans: ", status->scans, sizeof(status->scans) },
		{ "period: ", status->period, sizeof(status->period) },
		{ "late: ", status->late, sizeof(status->late) },
		{ "io: ", status->io, sizeof(status->io) },
	};

	if (!*line)
		return true;
	if (strncmp(line, "state: ", 7) == 0)
		status->stop[0] = '\0'; /* it is told only if there is one */
	if (strncmp(line, "scan: ", 6) == 0) {
		part(status->mean, sizeof(status->mean), line, "mean ");
		part(status->worst, sizeof(status->worst), line, "max ");
	}
	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++)
		if (strncmp(line, row[i].word, strlen(row[i].word)) == 0)
			snprintf(row[i].out, row[i].size, "%s",
				 line + strlen(row[i].word));
	return false;
}
