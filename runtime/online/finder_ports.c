/* SPDX-License-Identifier: MIT
 *
 * finder_ports - serial ports by the names of their devices; none is opened. Ports that every
 * PC has (ttyS0) are not among them.
 */
#include "online/finder.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void finder_text(char *out, int size, const char *text, int len)
{
	int used = 0;

	for (int i = 0; i < len && used + 1 < size; i++)
		out[used++] = (unsigned char)text[i] < ' ' || text[i] == 127 ? '?' : text[i];
	/* No half character of UTF-8 at the end. */
	if (used < len) {
		while (used && ((unsigned char)text[used] & 0xC0) == 0x80)
			used--;
	}
	out[used] = '\0';
}

static bool is_port(const char *name)
{
	static const char *const begins[] = { "ttyUSB", "ttyACM", "ttyAMA" };

	for (size_t i = 0; i < sizeof(begins) / sizeof(begins[0]); i++)
		if (strncmp(name, begins[i], strlen(begins[i])) == 0)
			return true;
	return false;
}

static int by_name(const void *a, const void *b)
{
	return strcmp(a, b);
}

int finder_ports(const char *folder, char out[][64], int most)
{
	DIR *dir = opendir(folder);
	const struct dirent *entry;
	int count = 0;

	while (dir && count < most && (entry = readdir(dir)))
		if (is_port(entry->d_name) &&
		    snprintf(out[count], sizeof(out[0]), "%.20s/%.40s", folder, entry->d_name) > 0)
			count++;
	if (dir)
		closedir(dir);
	qsort(out, (size_t)count, sizeof(out[0]), by_name);
	return count;
}
