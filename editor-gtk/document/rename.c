/* SPDX-License-Identifier: MIT
 *
 * rename - finds names in scenarios, plants and charts, and renames; see rename.h.
 */
#include "editor-gtk/document/rename.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/model/sfc.h"
#include "engine/trial/plant.h"
#include "engine/trial/scenario.h"

#include <stdlib.h>
#include <string.h>

#define FILE_MOST (4 << 20) /* bytes of a scenario or plant                     */
#define DEPTH     8         /* of indices inside indices                        */
#define ANY_NAME  "A_name_that_no_file_has" /* to count places                 */

/* A project and a name of it. */
struct naming {
	struct project *project;
	struct xref_target target;
};

struct plant_file {
	char *path;
	struct ladder *ladder;
	struct naming naming;       /* project NULL: it does not have the name  */
};

struct renaming {
	struct naming own, plant;   /* plant: of the text that is read; project NULL: none */
	const char *name;           /* the new one                              */
	GPtrArray *files;
	GPtrArray *plants;          /* of struct plant_file                     */
};

static void plant_file_free(gpointer data)
{
	struct plant_file *plant = data;

	ladder_free(plant->ladder);
	g_free(plant->path);
	g_free(plant);
}

static void file_free(gpointer data)
{
	struct rename_file *file = data;

	g_free(file->path);
	g_free(file->text);
	g_free(file);
}

static void add_file(struct renaming *renaming, const char *path, char *text, int places)
{
	struct rename_file *file = g_new(struct rename_file, 1);

	*file = (struct rename_file){ g_strdup(path), text, places };
	g_ptr_array_add(renaming->files, file);
}

/* The text as it is typed if the file is open, else of the disk. NULL: it cannot be read. */
static char *text_of(LadderDocument *document, const char *path, gsize *len)
{
	LadderSideFile *open = side_file_find(document, path);
	char *text = open ? ladder_side_file_text(open) : disk_read(path, FILE_MOST, len, NULL);

	if (text && !g_utf8_validate(text, -1, NULL))
		g_clear_pointer(&text, g_free);
	*len = text ? strlen(text) : 0;
	return text;
}

/* ---- what a name in a scenario means ---- */

/* After a part of a path: the table of its members; -1: it has none. */
struct meaning {
	struct xref_target target;
	int members;
};

static bool is_name(const struct project *project, uint32_t id, const char *text, size_t len)
{
	const char *name = project_text(project, id);

	return name_is(name, text, len);
}

static int members_of(const struct project *project, const struct var *var)
{
	if (var->type != IEC_NONE || var->fb == WORD_COUNT)
		return -1;
	for (int i = 0; i < project->structure_count; i++)
		if (project->structure[i].word == var->fb)
			return project->pou_count + 1 + i;
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].word == var->fb)
			return i + 1;
	return -1;
}

static bool find_in(struct project *project, int table, const char *text, size_t len,
		    struct meaning *out)
{
	const struct var_table *vars = xref_table(project, table);
	const struct pou *pou = table > 0 && table <= project->pou_count ?
				&project->pou[table - 1] : NULL;

	for (int i = 0; vars && i < vars->count; i++)
		if (is_name(project, vars->var[i].name, text, len)) {
			*out = (struct meaning){ xref_variable(project, table, i),
						 members_of(project, &vars->var[i]) };
			return true;
		}
	for (int i = 0; pou && pou->sfc && i < pou->sfc->step_count; i++)
		if (is_name(project, pou->sfc->step[i].name, text, len)) {
			*out = (struct meaning){ { .what = XREF_STEP, .table = table,
						   .index = i }, -1 };
			return true;
		}
	return false;
}

/* The first part of a path: a program before a dot, a global, or a local of a program. */
static bool find_head(struct project *project, const char *text, size_t len, bool dot,
		      struct meaning *out)
{
	if (find_in(project, 0, text, len, out))
		return true;
	for (int i = 0; dot && i < project->pou_count; i++)
		if (is_name(project, project->pou[i].name, text, len)) {
			*out = (struct meaning){ { .what = XREF_POU, .index = i }, i + 1 };
			return true;
		}
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_PROGRAM &&
		    find_in(project, i + 1, text, len, out))
			return true;
	return false;
}

/* ---- a scenario ---- */

struct rewriting {
	const struct renaming *renaming;
	GString *out;
	const char *done;     /* up to here the text is in @out                */
	int places;
	const struct naming *side; /* of the path that is read                 */
	struct meaning at;    /* the part before; members -1: nothing can follow */
};

static void take_part(struct rewriting *rewriting, const char *text, size_t len, bool found)
{
	if (!found) {
		rewriting->at.members = -1;
		return;
	}
	if (!rewriting->side->project ||
	    !xref_same(&rewriting->at.target, &rewriting->side->target))
		return;
	g_string_append_len(rewriting->out, rewriting->done, text - rewriting->done);
	g_string_append(rewriting->out, rewriting->renaming->name);
	rewriting->done = text + len;
	rewriting->places++;
}

/* A name with its dots. @goes_on: it stands behind the dot of an element of an array. */
static void take_path(struct rewriting *rewriting, const struct token *token, bool goes_on)
{
	const struct renaming *renaming = rewriting->renaming;
	const char *at = token->text, *end = token->text + token->len;
	bool first = !goes_on;

	if (first)
		rewriting->side = &renaming->own;
	while (at < end) {
		const char *dot = memchr(at, '.', (size_t)(end - at));
		const size_t len = (size_t)((dot ? dot : end) - at);
		struct project *project = rewriting->side->project;
		bool found;

		if (first && dot && ascii_is("plant", at, len) &&
		    !find_head(project, at, len, true, &rewriting->at)) {
			rewriting->side = &renaming->plant;
			at = dot + 1;
			if (!renaming->plant.project)
				return;
			continue;
		}
		found = first ? find_head(project, at, len, dot != NULL, &rewriting->at) :
			rewriting->at.members >= 0 &&
			find_in(project, rewriting->at.members, at, len, &rewriting->at);
		take_part(rewriting, at, len, found);
		if (!found)
			return;
		first = false;
		at = dot ? dot + 1 : end;
	}
}

/* `at 10ms`, `expect Motor`: a word of the language, not a variable of that name. */
static bool is_statement(const struct token *token, const struct lex *after)
{
	static const char *const words[] = { "scenario", "period", "speed", "plant", "at",
					     "expect", "within", "for", "always", "never" };

	for (gsize i = 0; i < G_N_ELEMENTS(words); i++)
		if (ascii_is(words[i], token->text, token->len))
			return after->token.kind == TOKEN_NUMBER ||
			       after->token.kind == TOKEN_STRING ||
			       after->token.kind == TOKEN_NAME ||
			       after->token.kind == TOKEN_ADDRESS || lex_is(after, "(");
	return false;
}

static void rewrite(struct rewriting *rewriting, const char *text, size_t len)
{
	struct rewriting outer[DEPTH];
	int depth = 0;
	bool goes_on = false, array = false;
	struct lex lex;

	lex_init(&lex, text, len);
	lex_next(&lex);
	while (lex.token.kind != TOKEN_END) {
		const struct token token = lex.token;

		if (token.kind == TOKEN_SYMBOL && *token.text == '#') {
			lex_skip_line(&lex);
			continue;
		}
		lex_next(&lex);
		if (token.kind == TOKEN_NAME) {
			if (!is_statement(&token, &lex))
				take_path(rewriting, &token, goes_on);
			array = true;
		} else if (*token.text == '[' && array && depth < DEPTH) {
			outer[depth++] = *rewriting;
		} else if (*token.text == ']' && depth > 0) {
			rewriting->at = outer[--depth].at;
			rewriting->side = outer[depth].side;
			array = true;
		} else {
			goes_on = *token.text == '.' && array;
			array = false;
			continue;
		}
		goes_on = false;
	}
	g_string_append(rewriting->out, rewriting->done);
}

/* The path of the plant that a scenario names; NULL: it names none. Caller frees. */
static char *named_plant(const char *path, const char *text, gsize len)
{
	struct token token;

	if (!scenario_plant_token(text, len, &token) || token.len <= 2)
		return NULL;
	char *folder = g_path_get_dirname(path);
	char *name = g_strndup(token.text + 1, token.len - 2);
	char *plant = g_canonicalize_filename(name, folder);

	g_free(name);
	g_free(folder);
	return plant;
}

/* The name in the plant of a scenario. */
static struct naming plant_naming(const struct renaming *renaming, const char *path,
				  const char *text, gsize len)
{
	char *named = named_plant(path, text, len);
	struct naming naming = { .project = NULL };

	for (guint i = 0; named && i < renaming->plants->len; i++) {
		const struct plant_file *plant = renaming->plants->pdata[i];

		if (disk_same(named, plant->path))
			naming = plant->naming;
	}
	g_free(named);
	return naming;
}

static void rename_in_scenario(struct renaming *renaming, LadderDocument *document,
			       const char *path)
{
	struct renaming own = *renaming;
	gsize len;
	char *text = text_of(document, path, &len);
	struct rewriting rewriting = { .renaming = &own, .done = text, .at = { .members = -1 } };

	if (!text)
		return;
	own.plant = plant_naming(renaming, path, text, len);
	rewriting.out = g_string_new(NULL);
	rewrite(&rewriting, text, len);
	if (rewriting.places > 0)
		add_file(renaming, path, g_string_free(rewriting.out, FALSE), rewriting.places);
	else
		g_string_free(rewriting.out, TRUE);
	g_free(text);
}

/* ---- a plant ---- */

static enum iec_area other_side(enum iec_area area)
{
	for (int i = 0; i < PLANT_PAIRS; i++)
		if (plant_pairs[i].out == area || plant_pairs[i].in == area)
			return plant_pairs[i].out == area ? plant_pairs[i].in :
							    plant_pairs[i].out;
	return AREA_NONE;
}

/* The global of the plant with the same name and the address on the other side; -1: none. */
static int find_twin(struct project *plant, const struct project *project,
		     const struct var *var)
{
	const char *name = project_text(project, var->name);

	for (int i = 0; i < plant->globals.count; i++) {
		const struct var *other = &plant->globals.var[i];

		if (is_name(plant, other->name, name, strlen(name)) &&
		    other->at.area == other_side(var->at.area) &&
		    other->at.bits == var->at.bits && other->at.byte == var->at.byte &&
		    other->at.bit == var->at.bit)
			return i;
	}
	return -1;
}

/* The names in the text, without changing how the rest is written. Caller frees. */
static char *with_name(const char *text, gsize len, const char *old, const char *name)
{
	GString *out = g_string_new(NULL);
	const char *done = text;
	struct lex lex;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		const struct token *token = &lex.token;
		const size_t head = token->kind != TOKEN_NAME ? 0 :
			name_head(old, strlen(old), token->text, token->len);

		if (!head)
			continue;
		g_string_append_len(out, done, token->text - done);
		g_string_append(out, name);
		done = token->text + head;
	}
	g_string_append(out, done);
	return g_string_free(out, FALSE);
}

static char *written(const char *text, gsize len)
{
	struct ladder *ladder = ladder_new();
	size_t size;
	char *out = ladder && ladder_load_text(ladder, "", text, len) ?
		    ladder_write(ladder, &size) : NULL;

	ladder_free(ladder);
	return out;
}

/* Adds the plant with the new name. False: it refuses the name, and @why says so. */
static bool rename_in_plant(struct renaming *renaming, const char *text, gsize len,
			    const struct plant_file *plant, char **why)
{
	const struct xref_target *target = &plant->naming.target;
	const struct project *project = plant->naming.project;
	const char *old = project_text(project, project->globals.var[target->index].name);
	struct ladder_rename how;
	size_t size;
	char *whole = ladder_rename(plant->ladder, target, renaming->name, &size, &how), *typed, *again;

	if (!whole) {
		char *file = g_path_get_basename(plant->path);

		*why = g_strdup_printf(_("“%s” cannot be its name in %s"), renaming->name, file);
		g_free(file);
		return false;
	}
	typed = with_name(text, len, old, renaming->name);
	again = written(typed, strlen(typed));
	if (g_strcmp0(again, whole) != 0) {
		g_free(typed);
		typed = g_strdup(whole);
	}
	add_file(renaming, plant->path, typed, how.places);
	free(again);
	free(whole);
	return true;
}

/* ---- all files ---- */

static void add_plant(GPtrArray *plants, char *path)
{
	struct plant_file *plant;

	for (guint i = 0; i < plants->len; i++)
		if (disk_same(path, ((struct plant_file *)plants->pdata[i])->path)) {
			g_free(path);
			return;
		}
	plant = g_new0(struct plant_file, 1);
	plant->path = path;
	plant->ladder = ladder_new();
	g_ptr_array_add(plants, plant);
}

/* "pump.plant.rung" of "pump.rung", and the plants that scenarios name. */
static void find_plants(struct renaming *renaming, LadderDocument *document, const char *path,
			const GPtrArray *scenarios)
{
	const char *dot = strrchr(path, '.');
	char *plant = g_strdup_printf("%.*s.plant.rung", (int)(dot ? dot - path :
							       (long)strlen(path)), path);

	if (g_file_test(plant, G_FILE_TEST_EXISTS))
		add_plant(renaming->plants, g_steal_pointer(&plant));
	g_free(plant);
	for (guint i = 0; i < scenarios->len; i++) {
		gsize len;
		char *text = text_of(document, scenarios->pdata[i], &len);

		plant = text ? named_plant(scenarios->pdata[i], text, len) : NULL;
		if (plant)
			add_plant(renaming->plants, plant);
		g_free(text);
	}
}

static bool take_plant(struct renaming *renaming, LadderDocument *document,
		       struct plant_file *plant, char **why)
{
	const struct var *var = xref_var(renaming->own.project, &renaming->own.target);
	gsize len;
	char *text = renaming->own.target.what == XREF_VARIABLE && var &&
		     var->at.area != AREA_NONE ? text_of(document, plant->path, &len) : NULL;
	bool good = true;
	int twin = -1;

	if (text && ladder_load_text(plant->ladder, plant->path, text, len))
		twin = find_twin(ladder_project(plant->ladder), renaming->own.project, var);
	if (twin >= 0) {
		plant->naming.project = ladder_project(plant->ladder);
		plant->naming.target = xref_variable(plant->naming.project, 0, twin);
		good = rename_in_plant(renaming, text, len, plant, why);
	}
	g_free(text);
	return good;
}

/* ---- status and timing charts ---- */

/* The name in a line of the VIEW part, "watch hex Name comment" or "timing Name", as
 * live/watch.h and live/timing.h describe them; NULL: the line has none. */
static const char *name_in_view(const char *line, gsize *len)
{
	const char *at = line + strspn(line, " \t");
	const gsize word = strcspn(at, " \t");
	const bool watch = word == 5 && strncmp(at, "watch", 5) == 0;

	if (!watch && !(word == 6 && strncmp(at, "timing", 6) == 0))
		return NULL;
	at += word + strspn(at + word, " \t");
	if (watch) {
		const gsize format = strcspn(at, " \t");

		at += format + strspn(at + format, " \t");
	}
	*len = strcspn(at, " \t\r");
	return *len ? at : NULL;
}

static void rename_in_line(struct renaming *renaming, const char *line, GString *out, int *places)
{
	struct rewriting rewriting = { .renaming = renaming, .out = out,
				       .at = { .members = -1 } };
	gsize len;
	const char *name = name_in_view(line, &len);
	char *alone;

	if (!name) {
		g_string_append(out, line);
		return;
	}
	g_string_append_len(out, line, name - line);
	alone = g_strndup(name, len);
	rewriting.done = alone;
	rewrite(&rewriting, alone, len);
	g_string_append(out, name + len);
	*places += rewriting.places;
	g_free(alone);
}

/* Adds the VIEW part, without a path, if a chart has the name. */
static void rename_in_view(struct renaming *renaming, LadderDocument *document)
{
	char **lines = g_strsplit(ladder_document_view(document), "\n", -1);
	const struct plant_file *plant = renaming->plants->len ? renaming->plants->pdata[0] : NULL;
	struct renaming own = *renaming;
	GString *out = g_string_new(NULL);
	int places = 0;

	own.plant = plant ? plant->naming : (struct naming){ .project = NULL };
	for (char **line = lines; *line; line++) {
		if (line != lines)
			g_string_append_c(out, '\n');
		rename_in_line(&own, *line, out, &places);
	}
	if (places > 0)
		add_file(renaming, NULL, g_string_free(out, FALSE), places);
	else
		g_string_free(out, TRUE);
	g_strfreev(lines);
}

GPtrArray *rename_files(LadderDocument *document, const struct xref_target *target,
			const char *name, char **why)
{
	struct project *project = ladder_document_project(document);
	const char *path = ladder_document_path(document);
	GPtrArray *scenarios = side_file_list(path, ".scn", true);
	struct renaming renaming = { .own = { project, *target },
		.name = name ? name : ANY_NAME, .files = g_ptr_array_new_with_free_func(file_free),
		.plants = g_ptr_array_new_with_free_func(plant_file_free) };
	bool good = true;

	if (path)
		find_plants(&renaming, document, path, scenarios);
	for (guint i = 0; good && i < renaming.plants->len; i++)
		good = take_plant(&renaming, document, renaming.plants->pdata[i], why);
	for (guint i = 0; good && i < scenarios->len; i++)
		rename_in_scenario(&renaming, document, scenarios->pdata[i]);
	if (good)
		rename_in_view(&renaming, document);
	else
		g_clear_pointer(&renaming.files, g_ptr_array_unref);
	g_ptr_array_unref(renaming.plants);
	g_ptr_array_unref(scenarios);
	return renaming.files;
}

/* ---- renaming ---- */

static char *place_of(struct project *project, const struct ladder_rename *how)
{
	const char *pou = how->pou < 0 ? "" :
		project_text(project, project->pou[how->pou].name);

	if (how->rung)
		return g_strdup_printf(_("%s, rung %d"), pou, how->rung);
	return g_strdup(*pou ? pou : _("the globals"));
}

char *rename_reason(LadderDocument *document, const struct ladder_rename *how,
		    const char *name)
{
	char *place = place_of(ladder_document_project(document), how), *text = NULL;

	switch (how->why) {
	case RENAME_GOOD:
	case RENAME_NOTHING:
		text = g_strdup(_("This has no name to change"));
		break;
	case RENAME_FORM:
		text = g_strdup_printf(_("“%s” is not a name"), name);
		break;
	case RENAME_RESERVED:
		text = g_strdup_printf(_("“%s” is a word of the language"), name);
		break;
	case RENAME_TAKEN:
		text = g_strdup_printf(_("“%s” is declared already (%s)"), name, place);
		break;
	case RENAME_MEANING:
		text = g_strdup_printf(_("“%s” would mean something else in %s"), name,
				       place);
		break;
	case RENAME_OTHER_FILE:
		text = g_strdup_printf(_("It is used in another file (%s)"), place);
		break;
	case RENAME_MEMORY:
		text = g_strdup(_("Out of memory"));
		break;
	}
	g_free(place);
	return text;
}

char *rename_refusal(LadderDocument *document, const struct xref_target *target,
		     const char *name)
{
	struct ladder_rename how;
	GPtrArray *files;
	size_t len;
	char *text = ladder_rename(ladder_document_ladder(document), target, name, &len, &how);
	char *why = NULL;

	if (!text)
		return rename_reason(document, &how, name);
	free(text);
	files = rename_files(document, target, name, &why);
	if (files)
		g_ptr_array_unref(files);
	return why;
}

static void put_file(LadderDocument *document, const struct rename_file *file)
{
	LadderSideFile *there = file->path ? side_file_find(document, file->path) : NULL;
	LadderSideFile *side = there ? g_object_ref(there) : file->path ?
			       ladder_side_file_open(file->path, document, NULL) : NULL;

	if (!file->path)
		ladder_document_set_view(document, file->text);
	if (!side)
		return;
	if (!there)
		g_signal_emit_by_name(document, "file-opened", side);
	ladder_side_file_set(side, file->text);
	g_object_unref(side);
}

bool rename_everywhere(LadderDocument *document, const struct xref_target *target,
		       const char *name, const char *step, int *places, char **why)
{
	GPtrArray *files = rename_files(document, target, name, why);
	struct ladder_rename how;
	size_t len, old_len;
	char *text = ladder_rename(ladder_document_ladder(document), target, name, &len, &how);
	char *before = ladder_document_outline(document, &old_len, NULL, NULL);
	char *old = target->what == XREF_POU ? g_strdup(project_text(
		ladder_document_project(document),
		ladder_document_project(document)->pou[target->index].name)) : NULL;
	bool good = files && text;

	if (files && !text)
		*why = rename_reason(document, &how, name);
	ladder_document_begin(document, step, NULL);
	if (good) {
		*why = ladder_document_replace_step(document, 0, old_len, text, step);
		good = !*why;
	}
	for (guint i = 0; good && i < files->len; i++) {
		put_file(document, files->pdata[i]);
		how.places += ((struct rename_file *)files->pdata[i])->places;
	}
	if (good && old)
		ladder_document_rename_bookmarks(document, old, name);
	ladder_document_end(document);
	if (places)
		*places = how.places;
	if (files)
		g_ptr_array_unref(files);
	g_free(old);
	g_free(before);
	free(text);
	return good;
}
