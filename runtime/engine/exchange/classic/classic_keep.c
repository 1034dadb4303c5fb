/* SPDX-License-Identifier: MIT
 *
 * classic_keep - lines that only ClassicLadder uses: Modbus requests, events, author, texts
 * on pages. An import keeps them in VIEW … END_VIEW, and an export writes them again.
 *
 * Numbers of a modem and passwords for mail are not kept.
 */
#include "engine/exchange/classic/classic_convert.h"
#include "engine/model/property.h"

#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

static const struct classic_member *member_named(const struct conversion *c, const char *name)
{
	for (int i = 0; i < c->project->members; i++)
		if (!strcmp(c->project->member[i].name, name))
			return &c->project->member[i];
	return NULL;
}

/* The next line of a member; false: there is none. */
static bool next_line(const char **at, const char *end, const char **line, size_t *len)
{
	const char *stop;

	if (*at >= end)
		return false;
	stop = memchr(*at, '\n', (size_t)(end - *at));
	*line = *at;
	*len = (size_t)((stop ? stop : end) - *at);
	*at = stop ? stop + 1 : end;
	while (*len && ((*line)[*len - 1] == '\r' || (*line)[*len - 1] == ' '))
		--*len;
	return true;
}

static bool says_something(const char *line, size_t len)
{
	return len && *line != '#' && *line != ';';
}

static bool is_property(const char *line, const char *equals)
{
	for (int i = 0; i < PROPERTY_COUNT; i++) {
		const char *key = property_row(i)->key;

		if (key && strlen(key) == (size_t)(equals - line) &&
		    !memcmp(key, line, strlen(key)))
			return true;
	}
	return false;
}

/* MODIF_DATE=… Not PROJECT_NAME and the keys of properties, which the file says itself. */
static bool says_who(const char *line, size_t len)
{
	const char *equals = memchr(line, '=', len);

	return says_something(line, len) && equals && equals + 1 < line + len &&
	       strncmp(line, "PROJECT_NAME=", 13) != 0 && !is_property(line, equals);
}

static bool is_serial(const char *line, size_t len)
{
	return len > 21 && !strncmp(line, "MODBUS_MASTER_SERIAL_", 21);
}

static bool is_note(const char *line, size_t len)
{
	return len > 2 && (*line == 'N' || *line == 'P') && line[1] >= '0' && line[1] <= '9';
}

/* As UTF-8, with a blank for each control character. */
static void put_kept(struct conversion *c, const char *member, const char *line, size_t len)
{
	const bool utf8 = utf8_valid(line, len, NULL);
	char *text = arena_alloc(c->arena, 2 * len + 1), *to = text;

	for (size_t i = 0; text && i < len; i++) {
		const unsigned char byte = (unsigned char)line[i];

		if (byte < ' ' || byte == 0x7F) {
			*to++ = ' ';
		} else if (byte < 0x80 || utf8) {
			*to++ = (char)byte;
		} else {
			*to++ = (char)(0xC0 | byte >> 6);
			*to++ = (char)(0x80 | (byte & 0x3F));
		}
	}
	if (text)
		put(c, "  %s %s %s\n", c->project->dialect == CLASSIC_LINUXCNC ? "linuxcnc" :
		    "classicladder", member, text);
}

static void keep(struct conversion *c, const char *name, bool *any,
		 bool (*wanted)(const char *line, size_t len))
{
	const struct classic_member *member = member_named(c, name);
	const char *at = member ? member->text : NULL, *line;
	const char *end = member ? member->text + member->len : NULL;
	size_t len;

	while (member && next_line(&at, end, &line, &len)) {
		if (!len || *line == ';' || (wanted && !wanted(line, len)))
			continue;
		if (!*any)
			put(c, "\nVIEW\n");
		*any = true;
		put_kept(c, name, line, len);
	}
}

static bool has_lines(const struct conversion *c, const char *name)
{
	const struct classic_member *member = member_named(c, name);
	const char *at = member ? member->text : NULL, *line;
	size_t len;

	while (member && next_line(&at, member->text + member->len, &line, &len))
		if (says_something(line, len))
			return true;
	return false;
}

void write_kept(struct conversion *c)
{
	bool any = false;

	if (c->project->dialect == CLASSIC_NUMERIC)
		return;
	keep(c, "project_infos.txt", &any, says_who);
	keep(c, "sequential.csv", &any, is_note);
	if (has_lines(c, "modbusioconf.csv")) {
		keep(c, "general.txt", &any, is_serial);
		keep(c, "com_params.txt", &any, NULL);
		keep(c, "modbusioconf.csv", &any, NULL);
	}
	if (has_lines(c, "config_events.csv"))
		keep(c, "config_events.csv", &any, NULL);
	if (any)
		put(c, "END_VIEW\n");
}

static bool has_setting(const struct conversion *c, const char *name, const char *setting)
{
	const struct classic_member *member = member_named(c, name);
	const char *at = member ? member->text : NULL, *line;
	size_t len;

	while (member && next_line(&at, member->text + member->len, &line, &len))
		if (len == strlen(setting) && !memcmp(line, setting, len))
			return true;
	return false;
}

/* ClassicLadder always writes these members: only one with something in it is reported. */
void report_kept(struct conversion *c)
{
	static const struct { const char *name, *setting, *text; } row[] = {
		{ "modbusioconf.csv", NULL, REPORTED("Modbus requests are not made; they are "
		  "kept for an export") },
		{ "config_events.csv", NULL, REPORTED("events are not logged; their list is kept "
		  "for an export") },
		{ "modem_config.txt", "MODEM_USED=1", REPORTED("the modem is not used") },
		{ "remote_alarms.txt", "GLOBAL_ENABLED=1",
		  REPORTED("alarms by SMS and mail are not sent") },
	};

	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++) {
		const struct classic_member *member = member_named(c, row[i].name);

		if (!member || !(row[i].setting ? has_setting(c, row[i].name, row[i].setting) :
						 has_lines(c, row[i].name)))
			continue;
		c->at = (struct classic_place){ member->name, member->line };
		tell(c, REPORT_LOST, "%s", report_said(c->report, row[i].text));
	}
}
