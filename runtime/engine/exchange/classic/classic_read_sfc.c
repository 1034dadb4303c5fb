/* SPDX-License-Identifier: MIT
 *
 * classic_read_sfc - the sequential pages of a ClassicLadder project: steps, transitions with
 * their conditions, comments.
 *
 * The lists of transitions that only the drawing needs are ignored.
 */
#include "engine/exchange/classic/classic_read.h"

enum {
	LISTS = 4,               /* activate, deactivate, and two for drawing  */
	PLACE = LISTS * CLASSIC_LINKS /* then page, x, y                       */
};

static bool good_place(struct classic_reader *reader, const int *page_x_y)
{
	return classic_in_range(reader, page_x_y[0], 0, CLASSIC_LIMIT - 1) &&
	       classic_in_range(reader, page_x_y[1], -1, CLASSIC_LIMIT) &&
	       classic_in_range(reader, page_x_y[2], -1, CLASSIC_LIMIT);
}

static void add_step(struct classic_reader *reader, int index, const char *at)
{
	struct classic_project *project = reader->project;
	struct classic_step *added;
	int value[5];

	if (!classic_numbers(reader, at, value, 5, 5) ||
	    !classic_in_range(reader, value[0], 0, 1) ||
	    !classic_in_range(reader, value[1], 0, CLASSIC_LIMIT - 1) ||
	    !good_place(reader, value + 2))
		return;
	added = arena_push(reader->arena, &project->step, &project->steps, sizeof(*added));
	if (added)
		*added = (struct classic_step){
			.index = index, .place = classic_here(reader),
			.initial = value[0], .number = value[1], .page = value[2],
			.x = value[3], .y = value[4] };
}

/* ClassicLadder ends the list at the first -1; so does this. */
static int take_links(struct classic_reader *reader, const int *value, int *link)
{
	bool open = true;
	int count = 0;

	for (int i = 0; i < CLASSIC_LINKS; i++) {
		if (!classic_in_range(reader, value[i], -1, CLASSIC_LIMIT - 1))
			return 0;
		if (value[i] < 0)
			open = false;
		else if (open)
			link[count++] = value[i];
		else
			classic_lost(reader, "a step behind the end of a transition's list");
	}
	return count;
}

static void add_transition(struct classic_reader *reader, int index, const char *at)
{
	struct classic_project *project = reader->project;
	struct classic_transition transition = {
		.index = index, .place = classic_here(reader),
		.condition = { .type = -1, .index_type = -1 } }, *added;
	int value[PLACE + 3];

	if (!classic_numbers(reader, at, value, PLACE + 3, PLACE + 3) ||
	    !good_place(reader, value + PLACE))
		return;
	transition.activates = take_links(reader, value, transition.activate);
	transition.deactivates = take_links(reader, value + CLASSIC_LINKS,
					    transition.deactivate);
	transition.page = value[PLACE];
	transition.x = value[PLACE + 1];
	transition.y = value[PLACE + 2];
	added = arena_push(reader->arena, &project->transition, &project->transitions,
			   sizeof(transition));
	if (added)
		*added = transition;
}

/* "PAGE,X,Y,TEXT"; the comment of a page, "TEXT", has no place. */
static void add_note(struct classic_reader *reader, const char *at, int numbers, int page)
{
	struct classic_project *project = reader->project;
	struct classic_note note = { .place = classic_here(reader), .page = page,
				     .x = -1, .y = -1 }, *added;
	const char *end = reader->line + reader->len;
	int value[3] = { page, -1, -1 };

	for (int i = 0; i < numbers; i++) {
		if (!classic_number(&at, end, &value[i]) || at == end || *at != ',') {
			classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
			return;
		}
		at++;
	}
	if (!good_place(reader, value))
		return;
	note.page = value[0];
	note.x = value[1];
	note.y = value[2];
	note.text = classic_text(reader, at, (size_t)(end - at));
	added = arena_push(reader->arena, &project->note, &project->notes, sizeof(note));
	if (added)
		*added = note;
}

static struct classic_transition *find_transition(struct classic_project *project,
						  int index, int *hint)
{
	/* Conditions nearly always stand in the order of their transitions. */
	for (int i = 0; i < project->transitions; i++) {
		int at = (*hint + i) % project->transitions;

		if (project->transition[at].index == index) {
			*hint = at + 1;
			return &project->transition[at];
		}
	}
	return NULL;
}

/* "0,TYPE/NUMBER" */
static void set_condition(struct classic_reader *reader, int index, const char *at,
			  int *hint)
{
	struct classic_transition *transition =
		find_transition(reader->project, index, hint);
	const char *end = reader->line + reader->len;
	struct classic_variable variable;
	int unused;

	if (!classic_number(&at, end, &unused) || at == end || *at != ',' ||
	    !classic_read_variable(at + 1, end, '/', &variable)) {
		classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
		return;
	}
	if (!classic_in_range(reader, variable.type, 0, 999) ||
	    !classic_in_range(reader, variable.number, 0, CLASSIC_LIMIT - 1))
		return;
	if (!transition)
		classic_lost(reader, "a condition without its transition");
	else
		transition->condition = variable;
}

/* @letter, a number and a comma; returns what follows, NULL: it is another line. */
static const char *begins(const struct classic_reader *reader, const char *letter,
			  int *index)
{
	const char *end = reader->line + reader->len;
	const char *at = classic_line_after(reader, letter);

	return at && classic_number(&at, end, index) && at < end && *at == ',' ?
	       at + 1 : NULL;
}

static void read_line(struct classic_reader *reader)
{
	const char *at;
	int index;

	if (*reader->line == '#')
		classic_version(reader, 1);
	else if ((at = begins(reader, "S", &index)) || (at = begins(reader, "T", &index)) ||
		 (at = begins(reader, "P", &index)) || (at = begins(reader, "N", &index))) {
		if (!classic_in_range(reader, index, 0, CLASSIC_LIMIT - 1))
			return;
		if (*reader->line == 'S')
			add_step(reader, index, at);
		else if (*reader->line == 'T')
			add_transition(reader, index, at);
		else
			add_note(reader, at, *reader->line == 'N' ? 3 : 0, index);
	} else if (!begins(reader, "C", &index)) {
		classic_fail(reader, DIAG_IMPORT_LINE, reader->line, reader->len);
	}
}

void classic_read_sfc(struct classic_reader *reader, const struct classic_member *member)
{
	int hint = 0, index;

	classic_member_begin(reader, member);
	while (classic_line_told(reader))
		read_line(reader);
	classic_member_begin(reader, member);
	while (classic_line_told(reader)) {
		const char *at = begins(reader, "C", &index);

		if (at)
			set_condition(reader, index, at, &hint);
	}
}
