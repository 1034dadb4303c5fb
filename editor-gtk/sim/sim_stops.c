/* SPDX-License-Identifier: MIT
 *
 * sim_stops - the breakpoints of a person in one program: see sim_stops.h.
 */
#include "editor-gtk/sim/sim_stops.h"

#include "editor-gtk/document/text_lines.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/st_formula.h"

#include "engine/base/name.h"
#include "engine/ladder.h"
#include "engine/model/sfc.h"
#include "engine/model/st.h"
#include "engine/trial/formula.h"

#include <stdlib.h>
#include <string.h>

/* ---- lines ---- */

/* The text of a program from the heading of a POU on, and which lines of it those of the document
 * are. */
struct match {
	const struct pou *pou;   /* of the program; NULL: it has none of that name */
	uint32_t entry;          /* in CODE_PROGRAMS                           */
	int *line;               /* by line of the document; -1: another one   */
	int count;
};

static const struct pou *find_pou(const struct project *project, const char *name)
{
	const int pou = project ? project_find_pou(project, name, strlen(name)) : -1;

	return pou >= 0 ? &project->pou[pou] : NULL;
}

static bool find_entry(const struct program *program, const char *name, uint32_t *entry)
{
	for (*entry = 0; *entry < program->entry_count; (*entry)++)
		if (name_equal(program->string + program->entry[*entry].name, name))
			return true;
	return false;
}

/* The POU whose action this is: Fill of Fill.Drain; of others itself. */
static uint32_t owner_of(const struct program *program, uint32_t entry)
{
	const char *name = program->string + program->entry[entry].name, *dot = strrchr(name, '.');
	char *own = dot ? g_strndup(name, (gsize)(dot - name)) : NULL;
	uint32_t owner;

	if (!own || !find_entry(program, own, &owner))
		owner = entry;
	g_free(own);
	return owner;
}

static const char *from_line(const char *text, int line)
{
	for (; text && line > 1; line--) {
		text = strchr(text, '\n');
		text = text ? text + 1 : NULL;
	}
	return text;
}

static bool find_match(struct match *match, const struct sim_program *program,
		       LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	const char *name = project && pou >= 0 && pou < project->pou_count ?
		project_text(project, project->pou[pou].name) : "";
	const char *text;
	char *own;

	*match = (struct match){ .pou = find_pou(ladder_project(program->ladder), name) };
	if (!match->pou || !match->pou->st || match->pou->included ||
	    !find_entry(program->program, name, &match->entry))
		return false;
	text = from_line(program->text, match->pou->line);
	own = ladder_document_list(document, pou);
	match->line = text && own ? text_lines_match(own, text, &match->count) : NULL;
	g_free(own);
	return match->line != NULL;
}

/* The line of the file of the program before which it stands; 0: none. */
static guint32 stand_line(const struct match *match, const struct sim_program *program, int line)
{
	while (line < match->count && match->line[line] < 0)
		line++;
	return line < 0 || line >= match->count ? 0 :
	       stops_line(program->program, match->entry,
			  (uint32_t)(match->line[line] + match->pou->line));
}

static int shown_line(const struct match *match, guint line)
{
	for (int i = 0; i < match->count; i++)
		if (match->line[i] >= 0 && (guint)(match->line[i] + match->pou->line) == line)
			return i;
	return -1;
}

int sim_stops_line(struct sim_program *program, LadderDocument *document, int pou, int line)
{
	struct match match;
	guint32 stands;
	int shown = -1;

	if (!find_match(&match, program, document, pou))
		return -1;
	stands = stand_line(&match, program, line);
	if (stands)
		shown = shown_line(&match, stands);
	free(match.line);
	return shown;
}

int sim_stops_shown(struct sim_program *program, LadderDocument *document, int pou, guint line)
{
	struct match match;
	int shown;

	if (!find_match(&match, program, document, pou))
		return -1;
	shown = shown_line(&match, line);
	free(match.line);
	return shown;
}

/* ---- conditions ---- */

/* @pou: the body, by its entry. */
static struct formula *formula_of(struct sim_program *program, struct arena *arena,
				  const char *scope, guint32 pou, const char *condition)
{
	struct image image = { .program = program->program };
	struct diag_list *ignored = g_new(struct diag_list, 1);
	struct expr *expr = arena_alloc(arena, sizeof(*expr));
	char *whole = st_formula_text(ladder_project(program->ladder), program->program, scope,
				      program->program->string + program->program->entry[pou].name,
				      condition);
	char *kept = arena_alloc(arena, strlen(whole) + 1);
	struct formula *formula = NULL;

	diag_init(ignored);
	if (expr && kept) {
		memcpy(kept, whole, strlen(whole) + 1);
		if (expr_parse_text(kept, strlen(kept), expr, ignored, (struct diag){ .id = DIAG_COUNT }))
			formula = formula_new(&image, NULL, (struct formula_projects){ NULL, NULL }, expr, arena, kept, ignored,
					      (struct diag){ .id = DIAG_COUNT });
	}
	g_free(whole);
	g_free(ignored);
	return formula && formula_kind(formula) == KIND_BOOL ? formula : NULL;
}

static void add(struct sim_stops *stops, struct sim_stop stop)
{
	g_array_append_val(stops->stop, stop);
}

/* A function block, or an action of one: one for each instance. False: some of them has no formula. */
static bool add_if(struct sim_stops *stops, struct sim_stop stop, const char *condition)
{
	const struct program *program = stops->program->program;
	const uint32_t owner = owner_of(program, stop.pou);
	const guint before = stops->stop->len;
	bool good = true;

	for (uint32_t i = 0; i < program->watched_count; i++) {
		if (program->watched[i].pou != owner)
			continue;
		stop.instance = program->string + program->watched[i].name;
		stop.condition = formula_of(stops->program, &stops->arena, stop.instance, owner,
					    condition);
		good = good && stop.condition;
		add(stops, stop);
	}
	if (stops->stop->len > before)
		return good;
	stop.condition = formula_of(stops->program, &stops->arena,
				    program->string + program->entry[owner].name, owner, condition);
	add(stops, stop);
	return stop.condition != NULL;
}

static bool add_one(struct sim_stops *stops, struct sim_stop stop, const char *condition)
{
	if (condition)
		return add_if(stops, stop, condition);
	add(stops, stop);
	return true;
}

/* Also further instances of a program, which have no POU of their name. */
static bool add_all(struct sim_stops *stops, const struct match *match, guint32 line, bool once,
		    const char *condition)
{
	const struct program *program = stops->program->program;
	const struct project *project = ladder_project(stops->program->ladder);
	bool good = true;

	for (uint32_t i = 0; i < program->entry_count; i++)
		if (i == match->entry ||
		    (!find_pou(project, program->string + program->entry[i].name) &&
		     stops_line(program, i, line) == line))
			good &= add_one(stops, (struct sim_stop){ .pou = i, .line = line, .once = once },
					condition);
	return good;
}

/* ---- all of them ---- */

static struct sim_stops *make(struct sim_program *program)
{
	struct sim_stops *stops = g_new0(struct sim_stops, 1);

	stops->program = sim_program_ref(program);
	stops->stop = g_array_new(FALSE, FALSE, sizeof(struct sim_stop));
	arena_init(&stops->arena);
	return stops;
}

struct sim_stops *sim_stops_new(struct sim_program *program, LadderDocument *document,
				LadderBreakpoints *points)
{
	struct sim_stops *stops = make(program);
	const struct project *project = ladder_document_project(document);

	for (guint i = 0; project && i < ladder_breakpoints_count(points); i++) {
		const struct breakpoint *point = ladder_breakpoints_at(points, i);
		struct match match;
		guint32 line;

		if (!find_match(&match, program, document,
				project_find_pou(project, point->pou, strlen(point->pou))))
			continue;
		line = stand_line(&match, program, point->line);
		if (line)
			add_all(stops, &match, line, false, point->condition);
		free(match.line);
	}
	return stops;
}

void sim_stops_free(struct sim_stops *stops)
{
	if (!stops)
		return;
	g_array_unref(stops->stop);
	arena_free(&stops->arena);
	sim_program_unref(stops->program);
	g_free(stops);
}

bool sim_stops_add(struct sim_stops *stops, LadderDocument *document, int pou, int line)
{
	struct match match;
	guint32 stands;

	if (!find_match(&match, stops->program, document, pou))
		return false;
	stands = stand_line(&match, stops->program, line);
	if (stands)
		add_all(stops, &match, stands, true, NULL);
	free(match.line);
	return stands != 0;
}

void sim_stops_give(const struct sim_stops *stops, struct stops *to)
{
	stops_clear(to);
	for (guint i = 0; i < stops->stop->len; i++) {
		const struct sim_stop *stop = &g_array_index(stops->stop, struct sim_stop, i);

		stops_add(to, stop->pou, stop->line, stop->condition, stop->instance, stop->once);
	}
}

/* ---- the check of a condition ---- */

#define HEAD "IF "

/* The line of the first statement of a body, of a chart that of an action; 0: none. */
static int first_statement(const struct pou *pou)
{
	int first = pou->sfc ? -1 : 0;

	for (int i = 0; first < 0 && i < pou->sfc->action_count; i++) {
		const struct sfc_body *body = &pou->sfc->action[i].body;

		if (body->kind == BODY_ST && body->count)
			first = body->first;
	}
	return pou->st && first >= 0 && first < pou->st->count ? pou->st->item[first].line : 0;
}

static const char *file_of(LadderDocument *document)
{
	const char *file = ladder_document_file(document);

	return g_intern_string(*file ? file : "-");
}

/* The text of the file with the condition in front of the first statement of the body. Caller frees;
 * *line: where, from 1. NULL: there is none. @ladder: reads the text, as the project of the document may have
 * been read from another form of it. */
static char *with_condition(LadderDocument *document, struct ladder *ladder, int pou, const char *condition,
			    int *line)
{
	char *text = ladder_document_text(document, NULL);
	const struct project *project = ladder_load_text(ladder, file_of(document), text, strlen(text)) ?
		ladder_project(ladder) : NULL;
	const char *at;
	char *with;

	*line = project && pou < project->pou_count ? first_statement(&project->pou[pou]) : 0;
	at = *line ? from_line(text, *line) : NULL;
	with = at ? g_strdup_printf("%.*s" HEAD "%s THEN ; END_IF;\n%s", (int)(at - text), text,
				    condition, at) : NULL;
	g_free(text);
	return with;
}

static char *first_error(const struct diag_list *diags, int line, int *column)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag->line != line || diag_severity(diag->id) != SEVERITY_ERROR)
			continue;
		*column = MAX(diag->column - 1 - (int)strlen(HEAD), -1);
		return diag_said_whole(diag);
	}
	return NULL;
}

static bool reads(LadderDocument *document, int pou, const char *condition)
{
	gsize len;
	char *text = ladder_document_text(document, &len);
	struct sim_program *program = sim_program_read_listed(ladder_document_reader(document),
		file_of(document), text, len, NULL);
	struct match match = { .pou = NULL };
	struct sim_stops *stops = program ? make(program) : NULL;
	const bool known = stops && find_match(&match, program, document, pou);
	const bool good = !known || add_all(stops, &match, 0, false, condition);

	free(match.line);
	sim_stops_free(stops);
	sim_program_unref(program);
	g_free(text);
	return good;
}

char *sim_stops_check(LadderDocument *document, int pou, const char *condition, int *column)
{
	const struct project *project = ladder_document_project(document);
	struct ladder *ladder = ladder_document_reader(document);
	int line = 0;
	char *text = project && pou >= 0 && pou < project->pou_count && ladder && !strchr(condition, '\n') ?
		with_condition(document, ladder, pou, condition, &line) : NULL;
	char *why = NULL;

	*column = -1;
	if (text) {
		if (ladder_load_text(ladder, file_of(document), text, strlen(text)))
			ladder_build(ladder);
		why = first_error(ladder_diags(ladder), line, column);
	}
	if (!why && !reads(document, pou, condition))
		why = g_strdup(_("While the program stands, a condition with a call cannot be computed"));
	g_free(text);
	ladder_free(ladder);
	return why;
}
