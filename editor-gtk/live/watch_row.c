/* SPDX-License-Identifier: MIT
 *
 * watch_row - a row of the status chart; see watch_row.h.
 */
#include "editor-gtk/live/watch_row.h"

#include "editor-gtk/kit/diag_said.h"

#include "engine/trial/value.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderWatchRow, ladder_watch_row, G_TYPE_OBJECT)

static void ladder_watch_row_finalize(GObject *object)
{
	LadderWatchRow *row = LADDER_WATCH_ROW(object);

	watch_line_free(row->line);
	g_free(row->typed);
	g_free(row->sent);
	G_OBJECT_CLASS(ladder_watch_row_parent_class)->finalize(object);
}

static void ladder_watch_row_class_init(LadderWatchRowClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_watch_row_finalize;
}

static void ladder_watch_row_init(LadderWatchRow *row)
{
	row->typed = g_strdup("");
	row->sent = g_strdup("");
}

LadderWatchRow *watch_row_new(const struct watch_line *line, const struct image *image,
			      LadderSim *sim)
{
	LadderWatchRow *row = g_object_new(LADDER_TYPE_WATCH_ROW, NULL);

	row->line = watch_line_new(line->format, line->name, line->comment);
	row->asked = image != NULL;
	row->at = live_value_find(image, line->name);
	if (row->at.type != IEC_NONE)
		row->named = live_named_find(sim, false, "", line->name);
	return row;
}


bool watch_row_equal(const LadderWatchRow *a, const LadderWatchRow *b)
{
	return a->asked == b->asked && a->at.constant == b->at.constant && a->at.type == b->at.type &&
	       (a->at.type == IEC_NONE || live_value_is_same(a->at, b->at)) &&
	       a->named.sim == b->named.sim && a->named.enumeration == b->named.enumeration &&
	       a->line->format == b->line->format &&
	       strcmp(a->line->name, b->line->name) == 0 &&
	       strcmp(a->line->comment, b->line->comment) == 0;
}

bool watch_row_is_unknown(const LadderWatchRow *row)
{
	return row->asked && row->at.type == IEC_NONE;
}

char *watch_row_value(const LadderWatchRow *row)
{
	const char *word = row->line->format != FORMAT_AUTO || !row->seen.known ? NULL :
			   live_named_word(row->named, row->seen.value);
	char text[IEC_VALUE_TEXT];

	if (!row->seen.known || word)
		return g_strdup(word ? word : "");
	live_value_format(row->line->format, row->at.type, row->seen.value, text,
			  sizeof(text));
	return g_strdup(text);
}

bool watch_row_parse(const LadderWatchRow *row, const struct image *image,
		      struct iec_text *room, union iec_value *out, char **why)
{
	enum diag_id fault = DIAG_COUNT;

	if (row->at.type == IEC_NONE)
		fault = DIAG_UNKNOWN_NAME;
	else if (row->at.constant)
		fault = DIAG_WRITE_CONSTANT;
	else if (live_named_parse(row->named, row->typed, out))
		return true;
	else if (live_value_parse(row->line->format, row->at.type, row->typed, room, out,
			     &fault))
		fault = value_has_room(image, row->at, *out) ? DIAG_COUNT :
			  DIAG_LITERAL_RANGE;
	if (fault == DIAG_COUNT)
		return true;
	*why = fault == DIAG_BAD_LITERAL ? live_named_wrong(row->named) : NULL;
	if (*why)
		return false;
	*why = diag_said_of(fault, fault == DIAG_UNKNOWN_NAME || fault == DIAG_WRITE_CONSTANT ?
				   row->line->name : row->typed);
	return false;
}
