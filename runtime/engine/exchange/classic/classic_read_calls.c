/* SPDX-License-Identifier: MIT
 *
 * classic_read_calls - which subroutine of a ClassicLadder project calls which, and how deep.
 *
 * There, one that comes back to itself ends the program. It looks at calls as they stand;
 * whether power can ever reach one is not asked.
 */
#include "engine/base/limits.h"
#include "engine/exchange/classic/classic_read.h"

enum { CALL = 55, DEEPEST = LIMIT_CALLS - 2, UNSEEN = 0, OPEN = -1 };

/* The way from a section to the cell that is looked at in it. */
struct frame {
	int section;
	const struct classic_rung *rung; /* NULL: it has been left             */
	int cell;                        /* the next one                       */
	int depth;                       /* of what it has called              */
};

struct calls {
	struct classic_reader *reader;
	int *target;   /* of each subroutine's number: its section, or -1      */
	int *depth;    /* of each section: how many call one another           */
	struct frame *frame;
	int frames;
};

static void push(struct calls *calls, int section)
{
	const struct classic_project *project = calls->reader->project;
	struct frame *frame = &calls->frame[calls->frames++];

	calls->depth[section] = OPEN;
	*frame = (struct frame){ .section = section };
	if (!project->section[section].sequential)
		frame->rung = classic_rung(project, project->section[section].first);
}

static void fail(struct calls *calls, const struct frame *frame, int y)
{
	const struct classic_rung *rung = frame->rung;
	const char *name = calls->reader->project->section[frame->section].name;
	struct classic_place place = { rung->place.member, rung->row_line[y] };

	classic_fail_at(calls->reader, DIAG_IMPORT_CALLS, place, name, strlen(name));
}

/* The section that the next call of this frame leads to; -1: it has no more. */
static int next_call(struct calls *calls, struct frame *frame, int *row)
{
	const struct classic_project *project = calls->reader->project;
	const struct classic_section *section = &project->section[frame->section];

	while (frame->rung) {
		while (frame->cell < CLASSIC_ROWS * CLASSIC_COLUMNS) {
			int y = frame->cell / CLASSIC_COLUMNS;
			const struct classic_cell *cell =
				&frame->rung->cell[y][frame->cell++ % CLASSIC_COLUMNS];

			*row = y;
			if (cell->element == CALL && calls->target[cell->variable.number] >= 0)
				return calls->target[cell->variable.number];
		}
		frame->rung = frame->rung->number == section->last ? NULL :
			      classic_rung(project, frame->rung->next);
		frame->cell = 0;
	}
	return -1;
}

/* From one section down; each section is looked at once. */
static bool look_from(struct calls *calls, int section)
{
	int row = 0;

	push(calls, section);
	while (calls->frames) {
		struct frame *frame = &calls->frame[calls->frames - 1];
		int to = next_call(calls, frame, &row);

		if (to >= 0 && calls->depth[to] == UNSEEN) {
			frame->cell--; /* once more when it is known               */
			if (calls->frames > DEEPEST) {
				fail(calls, frame, row);
				return false;
			}
			push(calls, to);
		} else if (to >= 0) {
			if (calls->depth[to] == OPEN || calls->depth[to] >= DEEPEST) {
				fail(calls, frame, row);
				return false;
			}
			if (calls->depth[to] > frame->depth)
				frame->depth = calls->depth[to];
		} else {
			calls->depth[frame->section] = frame->depth + 1;
			calls->frames--;
		}
	}
	return true;
}

void classic_calls(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	size_t sections = (size_t)project->sections;
	struct calls calls = { .reader = reader };

	calls.target = arena_alloc(reader->arena, CLASSIC_LIMIT * sizeof(int));
	calls.depth = arena_alloc(reader->arena, (sections + 1) * sizeof(int));
	calls.frame = arena_alloc(reader->arena, (sections + 1) * sizeof(struct frame));
	if (!calls.target || !calls.depth || !calls.frame)
		return;
	memset(calls.target, -1, CLASSIC_LIMIT * sizeof(int));
	for (int i = project->sections - 1; i >= 0; i--)
		if (project->section[i].subroutine >= 0 && !project->section[i].sequential)
			calls.target[project->section[i].subroutine] = i;
	for (int i = 0; i < project->sections; i++)
		if (calls.depth[i] == UNSEEN && !look_from(&calls, i))
			return;
}
