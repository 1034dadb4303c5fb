/* SPDX-License-Identifier: MIT
 *
 * to_classic_kept - writes the lines that an import kept in VIEW (classic_keep.c) again.
 *
 * Each is a line of a member. Lines of other members are ignored, and lines that would end
 * their member.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include "engine/base/ascii.h"

#include <stdlib.h>
#include <string.h>

enum { LINE = 290 }; /* bytes of a line that every version reads */

struct kept { const char *member, *text; size_t member_len, len; };

static bool word_is(const char *word, const char *text, size_t len)
{
	return strlen(word) == len && !memcmp(word, text, len);
}

/* "classicladder modbusioconf.csv S0,…". false: not for this export. @other: it is a line of
 * something else. */
static bool take_line(const struct leaving *e, const char *line, size_t len, struct kept *kept,
		      bool *other)
{
	const char *end = line + len, *space, *from;

	while (line < end && *line == ' ')
		line++;
	space = memchr(line, ' ', (size_t)(end - line));
	*other = false;
	if (!space || (!word_is("classicladder", line, (size_t)(space - line)) &&
		       !word_is("linuxcnc", line, (size_t)(space - line)))) {
		*other = line < end;
		return false;
	}
	from = space + 1;
	space = memchr(from, ' ', (size_t)(end - from));
	if (!space)
		return false;
	*kept = (struct kept){ from, space + 1, (size_t)(space - from),
			       (size_t)(end - space - 1) };
	/* Notes and names are the same in both dialects; other lines are of one dialect. */
	if (word_is("sequential.csv", kept->member, kept->member_len) ||
	    word_is("project_infos.txt", kept->member, kept->member_len))
		return true;
	*other = (*line == 'l') != (e->dialect == CLASSIC_LINUXCNC);
	return !*other;
}

/* A property of the project wins over a line that was kept. */
static bool is_set(const struct leaving *e, const char *key)
{
	for (int i = 0; i < PROPERTY_COUNT; i++) {
		const char *own = property_row(i)->key;

		if (own && !strcmp(own, key))
			return e->project->property[i];
	}
	return false;
}

static void keep_setting(struct leaving *e, const char *text)
{
	static const char *const known[] = { "PROJECT_SITE", "PARAM_VERSION", "PARAM_AUTHOR",
		"PARAM_COMPANY", "CREA_DATE", "MODIF_DATE", "PARAM_COMMENT",
		"MODBUS_MASTER_SERIAL_PORT", "MODBUS_MASTER_SERIAL_SPEED",
		"MODBUS_MASTER_SERIAL_DATABITS", "MODBUS_MASTER_SERIAL_PARITY",
		"MODBUS_MASTER_SERIAL_STOPBITS" };
	const char *equals = strchr(text, '=');

	for (size_t i = 0; equals && i < sizeof(known) / sizeof(*known); i++)
		if (word_is(known[i], text, (size_t)(equals - text)) &&
		    !is_set(e, known[i])) {
			struct classic_setting *one = arena_push(e->arena, &e->out->setting,
				&e->out->settings, sizeof(*one));

			if (one)
				*one = (struct classic_setting){ .key = known[i],
								 .value = equals + 1 };
		}
}

static int pages(const struct leaving *e)
{
	int count = 0;

	for (int i = 0; i < e->out->sections; i++)
		if (e->out->section[i].sequential && e->out->section[i].page >= count)
			count = e->out->section[i].page + 1;
	return count;
}

/* Adds a line to a member that is written unchanged. */
static void keep_member(struct leaving *e, const char *name, const char *text)
{
	struct classic_member *member = NULL;

	for (int i = 0; i < e->out->members; i++)
		if (!strcmp(e->out->member[i].name, name))
			member = &e->out->member[i];
	if (!member) {
		member = arena_push(e->arena, &e->out->member, &e->out->members,
				    sizeof(*member));
		if (!member)
			return;
		*member = (struct classic_member){ .name = name, .text = "" };
	}
	member->text = out_text(e, "%s%s\n", member->text, text);
	member->len = strlen(member->text);
}

/* N0,page,x,y,text and P0,text (only upstream) of a page that exists. */
static void keep_note(struct leaving *e, const char *text)
{
	const int size = e->dialect == CLASSIC_UPSTREAM ? 32 : 16;
	struct classic_note note, *added;
	char *end = NULL;
	long page = strtol(text + 1, &end, 10), value[3] = { 0, 0, 0 };

	if (*end != ',' || page < 0)
		return;
	if (*text == 'P') {
		if (e->dialect == CLASSIC_UPSTREAM && page < pages(e))
			keep_member(e, "sequential.csv", out_text(e, "P%ld,%.*s", page,
				classic_cut(end + 1, CLASSIC_NOTE), end + 1));
		return;
	}
	for (int i = 0; i < 3; i++) {
		value[i] = strtol(end + 1, &end, 10);
		if (*end != ',')
			return;
	}
	if (value[0] < 0 || value[0] >= pages(e) || value[1] < 0 || value[1] >= size ||
	    value[2] < 0 || value[2] >= size || e->out->notes >= 50)
		return;
	note = (struct classic_note){ .page = (int)value[0], .x = (int)value[1],
		.y = (int)value[2], .text = end + 1 };
	added = arena_push(e->arena, &e->out->note, &e->out->notes, sizeof(note));
	if (added)
		*added = note;
}

static void keep_line(struct leaving *e, const struct kept *kept)
{
	static const char *const whole[] = { "com_params.txt", "modbusioconf.csv",
					     "config_events.csv" };
	const char *text = out_text(e, "%.*s", (int)kept->len, kept->text);

	if (kept->len > LINE || *text == '_') /* it could end its member */
		return;
	if (word_is("project_infos.txt", kept->member, kept->member_len) ||
	    word_is("general.txt", kept->member, kept->member_len))
		keep_setting(e, text);
	else if (word_is("sequential.csv", kept->member, kept->member_len))
		keep_note(e, text);
	for (size_t i = 0; i < sizeof(whole) / sizeof(*whole); i++)
		if (word_is(whole[i], kept->member, kept->member_len))
			keep_member(e, whole[i], text);
}

void leave_kept(struct leaving *e)
{
	const char *at = project_view(e->project), *end;
	struct kept kept;
	bool other, others = false;

	if (*at)
		at = strchr(at, '\n') ? strchr(at, '\n') + 1 : "";
	for (; *at; at = *end ? end + 1 : end) {
		end = at + strcspn(at, "\n");
		if (!*end && !strncmp(at, "END_VIEW", 8))
			break;
		if (take_line(e, at, (size_t)(end - at), &kept, &other))
			keep_line(e, &kept);
		others |= other;
	}
	if (others)
		tell_line(e, 0, "settings of the editor (VIEW) are not exported");
}
