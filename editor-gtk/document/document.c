/* SPDX-License-Identifier: MIT
 *
 * document - one rung file while it is edited.
 *
 * Lists that cannot be read are kept beside the project and are saved with it.
 */
#include "editor-gtk/document/document.h"

#include "editor-gtk/document/bookmarks.h"
#include "editor-gtk/document/checker.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/plain_file.h"
#include "editor-gtk/document/history.h"
#include "editor-gtk/document/text_lines.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/scan/code.h"

#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>

struct beside {
	file_apply apply; /* NULL: the file is closed                          */
	const char *(*text)(gpointer file); /* NULL: not for INCLUDE           */
	const char *path;
	gpointer file;
};

/* Where the POUs stand in a text. */
struct pou_spans {
	struct text_span *span;
	int count;
};

struct _LadderDocument {
	GObject parent;
	struct ladder *ladder;    /* holds the live project                    */
	char *plain;              /* its canonical text; NULL: to be written when it is asked for */
	struct pou_spans spans;   /* of that text                              */
	char *text;               /* instead of it, if the file cannot be read */
	gsize text_len;
	GHashTable *list;         /* POU number -> text that cannot be read    */
	struct history *history;
	GArray *files;            /* of struct beside: text files whose edits are steps of the
				     history */
	char *path;
	char *copied;             /* the file that a document without a path is a copy of; NULL: none */
	char *from;               /* the original of an import that has no path; NULL: none */
	char *disk_sum;           /* digest of the file when it was read or saved */
	GStatBuf disk_seen;       /* the file at the last look                 */
	enum disk_state disk;     /* the result of that look                   */
	int repaired;             /* line of the first invalid byte; 0: none */
	bool fixed;               /* read-only                                 */
	guint64 version;
	struct checker *checker;
};

G_DEFINE_FINAL_TYPE(LadderDocument, ladder_document, G_TYPE_OBJECT)

enum { RUNGS_CHANGED, VARIABLE_CHANGED, PROJECT_CHANGED, LIST_CHANGED, BOOKMARKS_CHANGED,
       CHECKED, STATE_CHANGED, FILE_OPENED, SIGNALS };
static guint signals[SIGNALS];

static const char EMPTY_PROJECT[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\nEND_PROGRAM\n";

/* ---- what there is ---- */

const char *ladder_document_file(const LadderDocument *document)
{
	return document->path ? document->path : document->copied ? document->copied : "";
}

struct project *ladder_document_project(LadderDocument *document)
{
	return document->text ? NULL : ladder_project(document->ladder);
}

struct ladder *ladder_document_ladder(LadderDocument *document)
{
	return document->text ? NULL : document->ladder;
}

guint64 ladder_document_version(LadderDocument *document)
{
	return document->version;
}

const char *ladder_document_path(LadderDocument *document)
{
	return document->path;
}

char *ladder_document_folder(LadderDocument *document)
{
	const char *path = document->path ? document->path : document->from;

	return path ? g_path_get_dirname(path) : NULL;
}

void ladder_document_set_from(LadderDocument *document, const char *path)
{
	g_free(document->from);
	document->from = path ? g_canonicalize_filename(path, NULL) : NULL;
}

char *ladder_document_name(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	if (project && project->title)
		return g_strdup(project_text(project, project->title));
	return document->path ? g_path_get_basename(document->path) :
	       g_strdup(_("New project"));
}

char *ladder_document_outline(LadderDocument *document, gsize *len,
			      void (*take)(void *context, const struct text_span *span),
			      void *context)
{
	char *text, *copy;

	if (document->text)
		return NULL;
	text = ladder_outline(document->ladder, len, take, context);
	copy = g_strdup(text);
	free(text);
	return copy;
}

static const char *pou_name(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);

	return project && pou >= 0 && pou < project->pou_count ?
	       project_text(project, project->pou[pou].name) : NULL;
}

/* ---- signals ---- */

static void tell_state(LadderDocument *document)
{
	g_signal_emit(document, signals[STATE_CHANGED], 0);
}

static void tell_variable(LadderDocument *document, int pou, const char *name,
			    const char *address)
{
	g_signal_emit(document, signals[VARIABLE_CHANGED], 0, pou, name, address);
}

static void tell_whole(LadderDocument *document)
{
	g_signal_emit(document, signals[PROJECT_CHANGED], 0);
}

/* Whatever changes the live project calls this, before anyone hears of it. */
static void forget_plain(LadderDocument *document)
{
	g_clear_pointer(&document->plain, free);
	g_clear_pointer(&document->spans.span, g_free);
}

/* Before the signal of the change. */
static void count_version(LadderDocument *document)
{
	document->version++;
	forget_plain(document);
}

static void changed(LadderDocument *document)
{
	if (!document->fixed)
		checker_later(document->checker);
	g_signal_emit(document, signals[STATE_CHANGED], 0);
}

/* ---- lists that cannot be read ---- */

static void take_pou(void *context, const struct text_span *span)
{
	struct pou_spans *spans = context;

	if (span->part == TEXT_POU && span->number < spans->count)
		spans->span[span->number] = *span;
}

/* The canonical text, and where its POUs are. Caller frees both. */
static char *outline(struct ladder *ladder, struct pou_spans *spans)
{
	gsize len;
	char *text;

	spans->count = ladder_project(ladder)->pou_count;
	spans->span = g_new0(struct text_span, spans->count + 1);
	text = ladder_outline(ladder, &len, take_pou, spans);
	if (!text)
		g_error("out of memory");
	return text;
}

/* The canonical text of the live project. Many ask for it after each change, each sheet for itself.
 * Borrowed until the next change. */
static const char *plain_of(LadderDocument *document)
{
	if (!document->plain)
		document->plain = outline(document->ladder, &document->spans);
	return document->plain;
}

char *ladder_document_pou(LadderDocument *document, int pou, struct text_span *span)
{
	const char *text;

	if (document->text)
		return NULL;
	text = plain_of(document);
	*span = document->spans.span[pou];
	return g_strdup(text);
}

/* The canonical text with POU @pou replaced by @text. */
static char *with_list(const char *whole, const struct text_span *span,
		       const char *text)
{
	return g_strdup_printf("%.*s%s%s", (int)span->at, whole, text,
			       whole + span->at + span->len);
}

char *ladder_document_text(LadderDocument *document, gsize *len)
{
	gsize unused;
	char *text;

	len = len ? len : &unused;
	if (document->text) {
		*len = document->text_len;
		return g_memdup2(document->text, document->text_len + 1);
	}
	text = g_strdup(plain_of(document));
	/* Backwards: a replacement moves everything behind it. */
	for (int i = document->spans.count - 1; i >= 0; i--) {
		const char *list = g_hash_table_lookup(document->list,
						       GINT_TO_POINTER(i));

		if (list) {
			char *more = with_list(text, &document->spans.span[i], list);

			g_free(text);
			text = more;
		}
	}
	*len = strlen(text);
	return text;
}

char *ladder_document_list(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	const char *list = g_hash_table_lookup(document->list, GINT_TO_POINTER(pou));
	const char *text;

	if (list)
		return g_strdup(list);
	if (!project || pou < 0 || pou >= project->pou_count)
		return NULL;
	text = plain_of(document);
	return g_strndup(text + document->spans.span[pou].at, document->spans.span[pou].len);
}

/* The first POU that has such a list. */
static int first_list(LadderDocument *document)
{
	GHashTableIter iter;
	gpointer pou;
	int first = -1;

	g_hash_table_iter_init(&iter, document->list);
	while (g_hash_table_iter_next(&iter, &pou, NULL))
		if (first < 0 || GPOINTER_TO_INT(pou) < first)
			first = GPOINTER_TO_INT(pou);
	return first;
}

/* The line where the text of POU @pou begins, if no list stands before it. */
static int first_line(LadderDocument *document, int pou)
{
	struct text_span span = { 0 };
	char *text = ladder_document_pou(document, pou, &span);
	int line = 1;

	for (gsize i = 0; i < span.at; i++)
		line += text[i] == '\n';
	g_free(text);
	return line;
}

static void check_lists(LadderDocument *document, const struct project *read,
			  struct diag_list *diags)
{
	const struct project *project = ladder_document_project(document);
	const int pou = first_list(document);
	const bool fewer = project && read->pou_count < project->pou_count;
	const bool more = project && read->pou_count > project->pou_count;
	struct diag place = { .file = g_intern_string(ladder_document_file(document)) };

	if (pou < 0 || !project)
		return;
	place.pou = g_intern_string(project_text(project, project->pou[pou].name));
	place.id = fewer ? DIAG_EXPECTED : DIAG_MISPLACED;
	place.line = more ? read->pou[pou + 1].line : first_line(document, pou);
	diag_add(diags, place, "%s", fewer ? "PROGRAM" : more ?
		 project_text(read, read->pou[pou + 1].name) : "");
}

/* A list beside the project may have another length than the POU it stands for. */
int ladder_document_lines_before(LadderDocument *document, int pou)
{
	char *text, *list, *found;
	gsize len;
	int lines;

	if (pou < 0)
		return 0;
	text = ladder_document_text(document, &len);
	list = ladder_document_list(document, pou);
	found = list ? strstr(text, list) : NULL;
	if (found)
		*found = '\0';
	lines = found ? text_lines_count(text) : first_line(document, pou) - 1;
	g_free(list);
	g_free(text);
	return lines;
}

int ladder_document_list_at(LadderDocument *document, int line, int *row)
{
	GHashTableIter iter;
	gpointer pou, text;

	g_hash_table_iter_init(&iter, document->list);
	while (g_hash_table_iter_next(&iter, &pou, &text)) {
		*row = line - 1 - ladder_document_lines_before(document,
							       GPOINTER_TO_INT(pou));
		if (*row >= 0 && *row < text_lines_count(text) + !g_str_has_suffix(text, "\n"))
			return GPOINTER_TO_INT(pou);
	}
	return -1;
}

bool ladder_document_is_whole(LadderDocument *document)
{
	return g_hash_table_size(document->list) == 0;
}

/* ---- the text becomes the project ---- */

static char *text_beside(void *context, const char *path, size_t *len)
{
	const GPtrArray *texts = context; /* of pairs: path, text */

	for (guint i = 0; i + 1 < texts->len; i += 2)
		if (disk_same(texts->pdata[i], path)) {
			*len = strlen(texts->pdata[i + 1]);
			return strdup(texts->pdata[i + 1]);
		}
	return NULL;
}

static void free_texts(void *context)
{
	g_ptr_array_unref(context);
}

struct ladder *ladder_document_reader(LadderDocument *document)
{
	struct ladder *ladder = ladder_new();
	GPtrArray *texts = g_ptr_array_new_with_free_func(g_free);

	if (!ladder)
		g_error("out of memory");
	for (guint i = 0; document->files && i < document->files->len; i++) {
		const struct beside *beside = &g_array_index(document->files, struct beside, i);

		if (!beside->text)
			continue;
		g_ptr_array_add(texts, g_strdup(beside->path));
		g_ptr_array_add(texts, g_strdup(beside->text(beside->file)));
	}
	ladder_set_files(ladder, &(struct ladder_files){ text_beside, texts, true, free_texts });
	return ladder;
}

static struct ladder *read_text(LadderDocument *document, const char *text, gsize len,
			     struct diag_list *why)
{
	struct ladder *ladder = ladder_document_reader(document);
	const char *file = g_intern_string(ladder_document_file(document));

	if (ladder_load_text(ladder, file, text, len) && ladder_project(ladder))
		return ladder;
	if (why)
		*why = *ladder_diags(ladder);
	ladder_free(ladder);
	return NULL;
}

static void take_ladder(LadderDocument *document, struct ladder *ladder)
{
	forget_plain(document);
	ladder_free(document->ladder);
	document->ladder = ladder;
	g_clear_pointer(&document->text, g_free);
}

/* Takes over the project if the text can be read, else the text. */
static void take_text(LadderDocument *document, const char *text, gsize len)
{
	struct ladder *ladder = read_text(document, text, len, NULL);

	if (ladder) {
		take_ladder(document, ladder);
		return;
	}
	g_free(document->text);
	document->text = memcpy(g_malloc0(len + 1), text, len);
	document->text_len = len;
}

static void take(LadderDocument *document, const char *text, gsize len)
{
	count_version(document);
	g_hash_table_remove_all(document->list);
	take_text(document, text, len);
	history_restart(document->history);
	tell_whole(document);
	changed(document);
}

/* ---- where a person types in a list ---- */

/* The text before and behind a list, for one version of the document, so that a key does
 * not write thousands of rungs again. */
struct list_place {
	int pou;
	guint64 version;
	char *head, *tail;
	char *typed; /* the list as it was typed last; NULL: not yet           */
};

static void place_free(gpointer pointer)
{
	struct list_place *place = pointer;

	g_free(place->head);
	g_free(place->tail);
	g_free(place->typed);
	g_free(place);
}

static struct list_place *place_kept(LadderDocument *document, int pou, guint64 version)
{
	struct list_place *place = g_object_get_data(G_OBJECT(document), "list-place");

	return place && place->pou == pou && place->version >= version ? place : NULL;
}

static void forget_place(LadderDocument *document)
{
	g_object_set_data(G_OBJECT(document), "list-place", NULL);
}

/* Of version @version or later. Borrowed until the document changes. */
static struct list_place *place_since(LadderDocument *document, int pou, guint64 version)
{
	struct list_place *place = place_kept(document, pou, version);
	const struct text_span *span;
	const char *plain;

	if (place)
		return place;
	plain = plain_of(document);
	span = &document->spans.span[pou];
	place = g_new0(struct list_place, 1);
	place->pou = pou;
	place->head = g_strndup(plain, span->at);
	place->tail = g_strdup(plain + span->at + span->len);
	g_object_set_data_full(G_OBJECT(document), "list-place", place, place_free);
	return place;
}

/* While a change is applied, which has been counted. */
static struct list_place *place_of(LadderDocument *document, int pou)
{
	return place_since(document, pou, document->version - 1);
}

char *ladder_document_with_list(LadderDocument *document, int pou, const char *list)
{
	const struct project *project = ladder_document_project(document);
	struct list_place *place;

	if (!project || pou < 0 || pou >= project->pou_count || !ladder_document_is_whole(document))
		return NULL;
	place = place_since(document, pou, document->version);
	place->version = document->version;
	return g_strconcat(place->head, list, place->tail, NULL);
}

bool ladder_document_took(LadderDocument *document, const char *text)
{
	const struct list_place *place = g_object_get_data(G_OBJECT(document), "list-place");
	const gsize head = place ? strlen(place->head) : 0;
	const gsize typed = place && place->typed ? strlen(place->typed) : 0;

	return typed && place->version == document->version && ladder_document_is_whole(document) &&
	       strncmp(text, place->head, head) == 0 && strncmp(text + head, place->typed, typed) == 0 &&
	       strcmp(text + head + typed, place->tail) == 0;
}

/* ---- one POU, and nothing beside it ---- */

/* Is it PROGRAM or another word that begins a POU? @ends: with END_ before it. */
static bool is_pou_word(const struct token *token, bool ends)
{
	const size_t skip = ends ? strlen("END_") : 0;

	if (token->kind != TOKEN_NAME || token->len <= skip ||
	    (ends && g_ascii_strncasecmp(token->text, "END_", skip) != 0))
		return false;
	for (int i = 0; i < POU_KINDS; i++) {
		const char *word = pou_word((enum pou_kind)i);

		if (ascii_is(word, token->text + skip, token->len - skip))
			return true;
	}
	return false;
}

/* Does the text begin with such a word, and have exactly one that ends a POU, at its end? */
static bool is_plainly_one(const char *text)
{
	struct lex lex;
	bool begins, ended = false;

	lex_init(&lex, text, strlen(text));
	lex.comments = true;
	lex_next(&lex);
	begins = is_pou_word(&lex.token, false);
	while (begins && !ended && lex_next(&lex) != TOKEN_END)
		ended = is_pou_word(&lex.token, true);
	return ended && lex_next(&lex) == TOKEN_END;
}

/* Is everything but POU @pou unchanged, with no POU more or less? */
static bool same_beside(struct ladder *ladder, const struct list_place *place)
{
	struct pou_spans spans;
	char *is = outline(ladder, &spans);
	const struct text_span *now = &spans.span[place->pou];
	const bool same = spans.count > place->pou && now->at == strlen(place->head) &&
		memcmp(is, place->head, now->at) == 0 &&
		strcmp(is + now->at + now->len, place->tail) == 0;

	free(is);
	g_free(spans.span);
	return same;
}

/* ---- applying a change, forwards or backwards ---- */

/* An abort is better than a wrong program. */
static void report_lost(const char *what)
{
	g_error("the history does not fit the document: %s", what);
}

/* Bodies of a chart refer to rungs by number. */
static void shift_bodies(struct sfc *sfc, int at, int by)
{
	for (int i = 0; i < sfc_bodies(sfc); i++) {
		struct sfc_body *body = i < sfc->transition_count ?
			&sfc->transition[i].condition :
			&sfc->action[i - sfc->transition_count].body;

		if (!sfc_body_has_rungs(body))
			continue;
		if (body->first > at)
			body->first += by;
		else if (at < body->first + body->count)
			body->count += by;
	}
}

static void apply_rungs(LadderDocument *document, const struct change *change,
			const GPtrArray *from, const GPtrArray *to)
{
	struct project *project = ladder_project(document->ladder);
	struct pou *pou = &project->pou[change->pou];
	struct diag_list diags;

	diag_init(&diags);
	forget_plain(document);
	if (pou->sfc)
		shift_bodies(pou->sfc, (int)change->at, (int)to->len - (int)from->len);
	for (guint i = 0; i < from->len; i++)
		rung_free(project_take_rung(pou, (int)change->at));
	for (guint i = 0; i < to->len; i++) {
		const char *text = to->pdata[i];
		struct rung *rung = ladder_read_rung(document->ladder, text,
						     strlen(text), &diags);

		if (!rung || !project_add_rung(pou, (int)(change->at + i), rung))
			report_lost(text);
	}
	if (!ladder_take_boxes(document->ladder, change->pou))
		g_error("out of memory");
	g_signal_emit(document, signals[RUNGS_CHANGED], 0, change->pou,
		      (int)change->at, (int)from->len, (int)to->len);
}

/* A list that can be read goes into the project; any other is kept beside it. */
static void apply_list(LadderDocument *document, int pou, const char *text)
{
	struct list_place *place = place_of(document, pou);
	char *whole = g_strconcat(place->head, text, place->tail, NULL);
	struct ladder *ladder = read_text(document, whole, strlen(whole), NULL);

	g_free(whole);
	place->version = document->version;
	g_free(place->typed);
	place->typed = g_strdup(text);
	if (ladder && ladder_project(ladder)->pou_count ==
			      ladder_document_project(document)->pou_count &&
	    (is_plainly_one(text) || same_beside(ladder, place))) {
		take_ladder(document, ladder);
		g_hash_table_remove(document->list, GINT_TO_POINTER(pou));
		tell_whole(document);
	} else {
		ladder_free(ladder);
		g_hash_table_insert(document->list, GINT_TO_POINTER(pou),
				    g_strdup(text));
		g_signal_emit(document, signals[LIST_CHANGED], 0, pou);
	}
}

static struct var_table *table_of(struct project *project, int pou)
{
	return pou < 0 ? &project->globals : &project->pou[pou].vars;
}

static void pop(LadderDocument *document, int pou, int block, const char *text)
{
	struct project *project = ladder_project(document->ladder);
	struct var_table *table = table_of(project, pou);
	const struct var_block *of = &table->block[block];
	const struct var *var = &table->var[of->first + of->count - 1];

	if (of->count == 0 || !g_str_has_prefix(text, project_text(project, var->name)))
		report_lost(text);

	const char *name = project_text(project, var->name);
	const char *address = project_text(project, var->at_text);

	vars_pop(table, block);
	forget_plain(document);
	tell_variable(document, pou, name, address);
}

static void push(LadderDocument *document, int pou, int block, const char *text)
{
	struct project *project = ladder_project(document->ladder);
	struct diag_list diags;
	const struct var *var;

	diag_init(&diags);
	if (!ladder_read_var(document->ladder, pou, block, text, strlen(text), &diags))
		report_lost(text);
	forget_plain(document);

	const struct var_table *table = table_of(project, pou);

	var = &table->var[table->block[block].first + table->block[block].count - 1];
	tell_variable(document, pou, project_text(project, var->name),
			       project_text(project, var->at_text));
}

static void apply_variable(LadderDocument *document, int pou, int block,
			     const GPtrArray *from, const GPtrArray *to)
{
	for (guint i = from->len; i > 0; i--)
		pop(document, pou, block, from->pdata[i - 1]);
	for (guint i = 0; i < to->len; i++)
		push(document, pou, block, to->pdata[i]);
}

static void apply_view(LadderDocument *document, const char *text)
{
	if (!project_set_view(ladder_project(document->ladder), text))
		g_error("out of memory");
	forget_plain(document);
	g_signal_emit(document, signals[BOOKMARKS_CHANGED], 0);
}

static char *plain_text(LadderDocument *document, gsize *len)
{
	char *text, *copy;

	if (document->text)
		return ladder_document_text(document, len);
	text = ladder_write(document->ladder, len);
	if (!text)
		g_error("out of memory");
	copy = g_strdup(text);
	free(text);
	return copy;
}

/* File @number has another text: a project that includes it, or could not be read before, is read
 * again. If it cannot be, it stays as it is, and the check says why. */
static void read_again(LadderDocument *document, int number)
{
	const struct beside *beside = &g_array_index(document->files, struct beside, number);
	struct ladder *ladder;
	gsize len;
	char *text;

	if (!beside->text || !ladder_document_is_whole(document) ||
	    (!document->text && !ladder_document_includes(document, beside->path)))
		return;
	text = plain_text(document, &len);
	ladder = read_text(document, text, len, NULL);
	g_free(text);
	count_version(document);
	if (ladder) {
		take_ladder(document, ladder);
		tell_whole(document);
	}
	changed(document);
}

static void apply_file(LadderDocument *document, const struct change *change,
			 const char *from, const char *to)
{
	const struct beside *beside =
		&g_array_index(document->files, struct beside, change->pou);

	if (!beside->apply)
		report_lost(from);
	beside->apply(beside->file, change->at, from, to);
	read_again(document, change->pou);
}

static char *spliced(const char *text, gsize len, gsize at, gsize removed,
		     const char *with, gsize *out_len)
{
	gsize insert = strlen(with);
	char *out = g_malloc(len - removed + insert + 1);

	memcpy(out, text, at);
	memcpy(out + at, with, insert);
	memcpy(out + at + insert, text + at + removed, len - at - removed + 1);
	*out_len = len - removed + insert;
	return out;
}

/* A change of text may turn a document of text into a project, and back. */
static void apply_text(LadderDocument *document, const struct change *change,
		       const char *from, const char *to)
{
	gsize len, new_len;
	char *text = plain_text(document, &len), *out;

	if (change->at + strlen(from) > len ||
	    memcmp(text + change->at, from, strlen(from)) != 0)
		report_lost(from);
	out = spliced(text, len, change->at, strlen(from), to, &new_len);
	take_text(document, out, new_len);
	g_free(out);
	g_free(text);
	tell_whole(document);
}

static void apply_change(LadderDocument *document, const struct change *change, bool back)
{
	const GPtrArray *from = back ? change->after : change->before;
	const GPtrArray *to = back ? change->before : change->after;

	if (change->kind != CHANGE_LIST)
		forget_place(document);
	switch (change->kind) {
	case CHANGE_RUNGS:
		apply_rungs(document, change, from, to);
		break;
	case CHANGE_VARIABLE:
		apply_variable(document, change->pou, (int)change->at, from, to);
		break;
	case CHANGE_TEXT:
		apply_text(document, change, from->pdata[0], to->pdata[0]);
		break;
	case CHANGE_VIEW:
		apply_view(document, to->pdata[0]);
		break;
	case CHANGE_LIST:
		apply_list(document, change->pou, to->pdata[0]);
		break;
	case CHANGE_FILE:
		apply_file(document, change, from->pdata[0], to->pdata[0]);
		break;
	}
}

static void record(LadderDocument *document, struct change *change)
{
	count_version(document);
	apply_change(document, change, false);
	history_add(document->history, change);
	changed(document);
}

/* ---- steps ---- */

void ladder_document_fix(LadderDocument *document)
{
	document->fixed = true;
	checker_stop(document->checker);
}

bool ladder_document_is_fixed(LadderDocument *document)
{
	return document->fixed;
}

void ladder_document_begin(LadderDocument *document, const char *name, const char *key)
{
	history_begin(document->history, name, key);
}

void ladder_document_end(LadderDocument *document)
{
	if (history_end(document->history))
		tell_state(document);
}

/* Files come first, because the text of the project may include them. */
static void apply_kind(LadderDocument *document, const struct step *step, bool back, bool files)
{
	const int count = (int)step->change->len;

	for (int i = 0; i < count; i++) {
		const struct change *change = step->change->pdata[back ? count - 1 - i : i];

		if ((change->kind == CHANGE_FILE) == files)
			apply_change(document, change, back);
	}
}

static void apply_all(LadderDocument *document, const struct step *step, bool back)
{
	if (!step_is_aside(step))
		count_version(document);
	apply_kind(document, step, back, true);
	apply_kind(document, step, back, false);
	if (step_is_aside(step))
		tell_state(document);
	else
		changed(document);
}

void ladder_document_cancel(LadderDocument *document)
{
	const struct step *step = history_open_step(document->history);

	if (step && step->change->len > 0)
		apply_all(document, step, true);
	history_cancel(document->history);
}

void ladder_document_set_cursor(LadderDocument *document,
				struct step_cursor (*cursor)(gpointer data), gpointer data)
{
	history_set_cursor(document->history, cursor, data);
}

struct step_cursor ladder_document_undo_cursor(LadderDocument *document)
{
	return history_undo_cursor(document->history);
}

bool ladder_document_undo(LadderDocument *document)
{
	const struct step *step = history_undo(document->history);

	if (step)
		apply_all(document, step, true);
	return step;
}

bool ladder_document_redo(LadderDocument *document)
{
	const struct step *step = history_redo(document->history);

	if (step)
		apply_all(document, step, false);
	return step;
}

const char *ladder_document_undo_name(LadderDocument *document)
{
	return history_undo_name(document->history);
}

const char *ladder_document_redo_name(LadderDocument *document)
{
	return history_redo_name(document->history);
}

static GPtrArray *one_text(const char *text, gsize len)
{
	GPtrArray *texts = change_texts();

	g_ptr_array_add(texts, g_strndup(text, len));
	return texts;
}

/* ---- the VIEW part and its bookmarks ---- */

static char *view_text(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	return g_strdup(project ? project_view(project) : "");
}

/* Removes the part if it is empty and the last one: the editor added it. */
static void put_view(LadderDocument *document, const char *before, const char *after)
{
	char *plain = g_strstrip(g_strdup(after));

	if (strcmp(before, after) == 0 || document->fixed ||
	    !ladder_document_project(document)) {
		g_free(plain);
		return;
	}
	if (strcmp(plain, "VIEW\nEND_VIEW") == 0 &&
	    project_view_is_last(ladder_document_project(document)))
		after = "";
	record(document, change_new(CHANGE_VIEW, -1, 0,
					     one_text(before, strlen(before)),
					     one_text(after, strlen(after))));
	g_free(plain);
}

static void shift_view(LadderDocument *document, const struct bookmark_shift *shift)
{
	char *before = view_text(document), *after = bookmarks_shift(before, shift);

	put_view(document, before, after);
	g_free(before);
	g_free(after);
}

static void shift_bookmarks(LadderDocument *document, int pou, int at, int removed,
			      int inserted)
{
	const char *name = pou_name(document, pou);
	const struct bookmark_shift shift = { name, name, at, removed, inserted, -1, false };

	if (removed != inserted)
		shift_view(document, &shift);
}

static void move_bookmarks(LadderDocument *document, int pou, int from, int to,
			     const char *view)
{
	const char *name = pou_name(document, pou);
	const struct bookmark_shift shift = { name, name, to, 0, 0, from, false };
	char *before = view_text(document), *after = bookmarks_shift(view, &shift);

	put_view(document, before, after);
	g_free(before);
	g_free(after);
}

static bool is_taken(LadderDocument *document, int pou, const char *name)
{
	const int pous = ladder_document_project(document)->pou_count;

	for (int i = 0; i < pous; i++)
		if (i != pou && name_equal(pou_name(document, i), name))
			return true;
	return false;
}

/* While a name is being typed two POUs may have the same one: the other keeps its
 * bookmarks. */
static void follow_name(LadderDocument *document, int pou, const char *before)
{
	const char *now = pou_name(document, pou);

	if (before && now && strcmp(before, now) != 0 && !is_taken(document, pou, before) &&
	    !is_taken(document, pou, now))
		ladder_document_rename_bookmarks(document, before, now);
}

void ladder_document_rename_bookmarks(LadderDocument *document, const char *from,
				      const char *to)
{
	const struct bookmark_shift shift = { from, to, 0, 0, 0, -1, false };

	shift_view(document, &shift);
}

const char *ladder_document_view(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	return project ? project_view(project) : "";
}

void ladder_document_set_view(LadderDocument *document, const char *view)
{
	char *before = view_text(document);

	put_view(document, before, view);
	g_free(before);
}

bool ladder_document_is_bookmarked(LadderDocument *document, int pou, int rung)
{
	const char *name = pou_name(document, pou);

	return name && bookmarks_have(ladder_document_view(document), name, rung);
}

bool ladder_document_next_bookmark(LadderDocument *document, int *pou, int *rung)
{
	const struct project *project = ladder_document_project(document);
	const int pous = project ? project->pou_count : 0;

	if (pous == 0 || !project_view(project)[0])
		return false;
	for (int i = 0, at = MAX(*pou, 0), from = *rung + 1; i <= pous;
	     i++, at = (at + 1) % pous, from = 0)
		for (int n = from; n < project->pou[at].rung_count; n++)
			if (ladder_document_is_bookmarked(document, at, n)) {
				*pou = at;
				*rung = n;
				return true;
			}
	return false;
}

void ladder_document_toggle_bookmark(LadderDocument *document, int pou, int rung)
{
	const char *name = pou_name(document, pou);
	const struct bookmark_shift drop = { name, name, rung, 0, 0, -1, true };
	const bool is = ladder_document_is_bookmarked(document, pou, rung);
	char *before, *after;

	if (!name)
		return;
	before = view_text(document);
	after = is ? bookmarks_shift(before, &drop) : bookmarks_add(before, name, rung);
	ladder_document_begin(document, is ? _("Clear bookmark") : _("Set bookmark"), NULL);
	put_view(document, before, after);
	ladder_document_end(document);
	g_free(before);
	g_free(after);
}

/* ---- rungs ---- */

/* The text of a rung; NULL, and @why: a file cannot hold it. */
static char *rung_text(LadderDocument *document, const struct rung *rung,
		       struct diag_list *why)
{
	struct diag_list diags;
	char *text = ladder_write_rung(document->ladder, rung), *copy = NULL;
	struct rung *again;

	diag_init(&diags);
	again = text ? ladder_read_rung(document->ladder, text, strlen(text), &diags) :
		NULL;
	if (again && rung_equal(again, rung))
		copy = g_strdup(text);
	else if (why)
		*why = diags;
	rung_free(again);
	free(text);
	return copy;
}

static bool same_texts(const GPtrArray *a, const GPtrArray *b)
{
	if (a->len != b->len)
		return false;
	for (guint i = 0; i < a->len; i++)
		if (strcmp(a->pdata[i], b->pdata[i]) != 0)
			return false;
	return true;
}

static bool add_texts(LadderDocument *document, GPtrArray *texts,
		      struct rung *const *rungs, int count, struct diag_list *why)
{
	for (int i = 0; i < count; i++) {
		char *text = rung_text(document, rungs[i], why);

		if (!text)
			return false;
		g_ptr_array_add(texts, text);
	}
	return true;
}

/* In a chart an edit must stay inside one body and must not empty it; a condition has one
 * rung. */
static bool fits_body(const struct sfc *sfc, int at, int removed, int inserted)
{
	for (int i = 0; i < sfc_bodies(sfc); i++) {
		const struct sfc_body *body = sfc_body(sfc, i);

		if (!sfc_body_has_rungs(body) || at < body->first || at + removed > body->first + body->count)
			continue;
		return removed > 0 && inserted > 0 &&
		       (i >= sfc->transition_count || removed == inserted);
	}
	return false;
}

bool ladder_document_splice(LadderDocument *document, int pou, int at, int removed,
			    struct rung **rungs, int inserted, struct diag_list *why)
{
	struct project *project = ladder_document_project(document);
	GPtrArray *before = change_texts(), *after = change_texts();
	struct pou *of = project && pou >= 0 && pou < project->pou_count ?
		&project->pou[pou] : NULL;
	bool good = of && !document->fixed && of->language != LANGUAGE_IL && of->language != LANGUAGE_ST && !of->fbd &&
		!of->included && at >= 0 &&
		!g_hash_table_contains(document->list, GINT_TO_POINTER(pou)) &&
		(!of->sfc || fits_body(of->sfc, at, removed, inserted)) &&
		removed >= 0 && at + removed <= of->rung_count &&
		of->rung_count - removed + inserted <= LIMIT_RUNGS &&
		add_texts(document, before, of->rung + at, removed, why) &&
		add_texts(document, after, rungs, inserted, why);

	for (int i = 0; i < inserted; i++)
		rung_free(rungs[i]);
	if (good && !same_texts(before, after)) {
		ladder_document_begin(document, _("Edit rungs"), NULL);
		record(document, change_new(CHANGE_RUNGS, pou, (gsize)at, before, after));
		shift_bookmarks(document, pou, at, removed, inserted);
		ladder_document_end(document);
	} else {
		g_ptr_array_unref(before);
		g_ptr_array_unref(after);
	}
	return good;
}

bool ladder_document_put_rung(LadderDocument *document, int pou, int at,
			      struct rung *rung, struct diag_list *why)
{
	return ladder_document_splice(document, pou, at, 1, &rung, 1, why);
}

bool ladder_document_move_rung(LadderDocument *document, int pou, int from, int to)
{
	const struct project *project = ladder_document_project(document);
	struct rung *copy;
	char *view;
	bool good;

	if (!project || pou < 0 || pou >= project->pou_count || from < 0 || to < 0 ||
	    from >= project->pou[pou].rung_count || to >= project->pou[pou].rung_count)
		return false;
	copy = rung_copy(project->pou[pou].rung[from]);
	view = g_strdup(project_view(project));
	ladder_document_begin(document, _("Move rung"), NULL);
	good = ladder_document_splice(document, pou, from, 1, NULL, 0, NULL) &&
	       ladder_document_splice(document, pou, to, 0, &copy, 1, NULL);
	if (good)
		move_bookmarks(document, pou, from, to, view);
	ladder_document_end(document);
	g_free(view);
	return good;
}

/* ---- text ---- */

/* @text after it was read and written. NULL, and @why: it cannot be read, or it has another
 * number of POUs while lists are kept beside the project. */
static char *canonical(LadderDocument *document, const char *text, gsize len,
		       struct diag_list *why)
{
	struct ladder *ladder = read_text(document, text, len, why);
	char *out = NULL;
	gsize out_len;

	if (ladder && (g_hash_table_size(document->list) == 0 ||
		       ladder_project(ladder)->pou_count ==
		       ladder_project(document->ladder)->pou_count))
		out = ladder_write(ladder, &out_len);
	else if (ladder && why)
		*why = *ladder_diags(ladder);
	ladder_free(ladder);
	return out;
}

/* Leaves out what both texts have in common at both ends. */
static struct change *text_change(const char *from, const char *to)
{
	gsize from_len = strlen(from), to_len = strlen(to), at = 0, end = 0;
	const gsize shorter = MIN(from_len, to_len);

	while (at < shorter && from[at] == to[at])
		at++;
	while (end < shorter - at &&
	       from[from_len - 1 - end] == to[to_len - 1 - end])
		end++;
	return change_new(CHANGE_TEXT, -1, at, one_text(from + at, from_len - at - end),
			  one_text(to + at, to_len - at - end));
}

bool ladder_document_replace(LadderDocument *document, gsize at, gsize removed,
			     const char *with, struct diag_list *why)
{
	gsize len, new_len;
	char *text = plain_text(document, &len), *out, *clean;
	bool good = false;

	if (why)
		diag_init(why);
	if (!document->fixed && at <= len && removed <= len - at) {
		out = spliced(text, len, at, removed, with, &new_len);
		clean = canonical(document, out, new_len, why);
		good = clean || document->text;
		if (good && strcmp(text, clean ? clean : out) != 0)
			record(document, text_change(text, clean ? clean : out));
		free(clean);
		g_free(out);
	}
	g_free(text);
	return good;
}

char *ladder_document_replace_step(LadderDocument *document, gsize at, gsize removed,
				   const char *with, const char *step)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	const struct diag *error;
	char *why = NULL;

	ladder_document_begin(document, step, NULL);
	if (!ladder_document_replace(document, at, removed, with, diags)) {
		error = diag_first_error(diags);
		why = error ? diag_said_whole(error) : g_strdup(_("It cannot be read"));
	}
	ladder_document_end(document);
	g_free(diags);
	return why;
}

/* The list as it was typed, if that is known, else as the file has it. */
static char *list_before(LadderDocument *document, int pou)
{
	const struct list_place *place = place_kept(document, pou, document->version);

	return place && place->typed ? g_strdup(place->typed) :
	       ladder_document_list(document, pou);
}

bool ladder_document_put_list(LadderDocument *document, int pou, const char *text)
{
	char *before = list_before(document, pou);
	char *name = g_strdup(pou_name(document, pou));
	bool same = before && strcmp(before, text) == 0;

	if (before && !same && !document->fixed) {
		ladder_document_begin(document, _("Type text"), NULL);
		record(document, change_new(CHANGE_LIST, pou, 0,
					    one_text(before, strlen(before)),
					    one_text(text, strlen(text))));
		follow_name(document, pou, name);
		ladder_document_end(document);
	}
	g_free(name);
	g_free(before);
	return before;
}

/* ---- a variable, into a block of the live project ---- */

static bool is_plain(const struct var_table *table, int block)
{
	return (table->block[block].flags & ~VAR_GLOBAL_WORD) == 0;
}

static int last_of_config(const struct project *project, int found)
{
	for (int i = 0; i < project->config->count; i++) {
		const struct config_entry *entry = &project->config->entry[i];

		if (entry->kind == CONFIG_VARS && is_plain(&project->globals, entry->block))
			found = entry->block;
	}
	return found;
}

/* The last plain block in the order of the file; -1: there is none. */
static int last_global(const struct project *project)
{
	int found = -1;

	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if (part->included)
			continue;
		if (part->kind == PART_VARS && is_plain(&project->globals, part->index))
			found = part->index;
		else if (part->kind == PART_CONFIG && project->config)
			found = last_of_config(project, found);
	}
	return found;
}

static int last_of_pou(const struct pou *pou)
{
	int found = -1;

	for (int i = 0; i < pou->vars.block_count; i++)
		if (is_plain(&pou->vars, i))
			found = i;
	return found;
}

/* A POU with a frame has a size that others use: its variables cannot change in place. */
static int live_block(const struct project *project, int pou)
{
	const struct pou *of = pou < 0 ? NULL : &project->pou[pou];

	if (!of)
		return last_global(project);
	return of->included || pou_has_frame(of) ? -1 : last_of_pou(of);
}

static bool declare_live(LadderDocument *document, int pou, int block, const char *text,
			 struct diag_list *why)
{
	const gsize len = strlen(text);
	struct diag_list diags;

	diag_init(&diags);
	if (!ladder_read_var(document->ladder, pou, block, text, len, &diags)) {
		if (why)
			*why = diags;
		return false;
	}
	vars_pop(table_of(ladder_project(document->ladder), pou), block);
	record(document, change_new(CHANGE_VARIABLE, pou, (gsize)block,
					     change_texts(), one_text(text, len)));
	return true;
}

/* ---- a variable, as a line of the text ---- */

/* A place for a new line: the end of a plain block, or before another part. */
struct opening {
	const struct project *project;
	int pou;              /* -1: global                                    */
	bool found;
	gsize at;             /* of END_VAR                                    */
	gsize heading;        /* behind the POU's first line                   */
	gsize first_pou;      /* the first part that is one; 0: none           */
};

static uint16_t block_flags(const struct opening *place, const struct text_span *span)
{
	const struct var_table *table = span->pou < 0 ? &place->project->globals :
		&place->project->pou[span->pou].vars;

	return table->block[span->number].flags;
}

static void look(void *context, const struct text_span *span)
{
	static const char end[] = "END_VAR\n";
	struct opening *place = context;

	if (span->part == TEXT_BLOCK && span->pou == place->pou &&
	    span->structure < 0 &&
	    (block_flags(place, span) & ~VAR_GLOBAL_WORD) == 0) {
		place->found = true;
		place->at = span->at + span->len - strlen(end);
	}
	if (span->part == TEXT_POU && span->number == place->pou)
		place->heading = span->at;
	if (span->part == TEXT_PART && !place->first_pou &&
	    place->project->part[span->number].kind == PART_POU)
		place->first_pou = span->at;
}

static bool declare_in_text(LadderDocument *document, int pou, const char *declaration,
			    struct diag_list *why)
{
	struct opening place = { .project = ladder_document_project(document), .pou = pou };
	gsize len;
	char *text = ladder_document_outline(document, &len, look, &place), *line;
	bool good;

	if (place.found) {
		line = g_strdup_printf("  %s\n", declaration);
	} else if (pou >= 0) {
		place.at = (gsize)(strchr(text + place.heading, '\n') + 1 - text);
		line = g_strdup_printf("VAR\n  %s\nEND_VAR\n", declaration);
	} else {
		place.at = place.first_pou ? place.first_pou : len;
		line = g_strdup_printf("VAR\n  %s\nEND_VAR\n\n", declaration);
	}
	good = ladder_document_replace(document, place.at, 0, line, why);
	g_free(line);
	g_free(text);
	return good;
}

bool ladder_document_declare(LadderDocument *document, int pou, const char *name,
			     const char *type, const char *address,
			     struct diag_list *why)
{
	struct project *project = ladder_document_project(document);
	char *declaration;
	bool good;
	int block;

	if (!project || pou >= project->pou_count || document->fixed)
		return false;
	declaration = g_strdup_printf("%s%s%s : %s;", name,
				      address && address[0] ? " AT " : "",
				      address ? address : "", type);
	block = live_block(project, pou);
	good = block >= 0 ? declare_live(document, pou, block, declaration, why) :
	       declare_in_text(document, pou, declaration, why);
	g_free(declaration);
	return good;
}

/* ---- places in the history ---- */

guint64 ladder_document_place(LadderDocument *document)
{
	return history_place(document->history);
}

bool ladder_document_knows_place(LadderDocument *document, guint64 place)
{
	return history_since(document->history, place) >= 0;
}

enum relation {
	STEP_EDIT,  /* of that rung, perhaps with declarations                 */
	STEP_ASIDE, /* of nothing that the rung depends on                     */
	STEP_OTHER,
};

static enum relation relation_of(const struct step *step, int pou, int rung)
{
	bool edits = false, declares = false;

	for (guint i = 0; i < step->change->len; i++) {
		const struct change *change = step->change->pdata[i];

		switch (change->kind) {
		case CHANGE_RUNGS:
			if (change->pou != pou || change->at != (gsize)rung ||
			    change->before->len != 1 || change->after->len != 1)
				return STEP_OTHER;
			edits = true;
			break;
		case CHANGE_TEXT:
		case CHANGE_VARIABLE:
			declares = true;
			break;
		case CHANGE_LIST:
			return STEP_OTHER;
		case CHANGE_VIEW:
		case CHANGE_FILE:
			break;
		}
	}
	return edits ? STEP_EDIT : declares ? STEP_OTHER : STEP_ASIDE;
}

/* Steps since the rung was as it was at @place, or since it was last given back. */
static int steps_since(LadderDocument *document, guint64 place)
{
	const int count = history_since(document->history, place);

	for (int i = 0; i < count; i++) {
		const struct step *step = history_done(document->history, i);

		if (step->is_back && step->back_to == place)
			return i;
	}
	return count;
}

/* Do the last @count steps edit only the rung, with nothing that depends on them? */
static enum back judge(LadderDocument *document, int pou, int rung, int count)
{
	enum back back = BACK_NOTHING;
	bool other = false;

	for (int i = 0; i < count; i++) {
		const enum relation relation = relation_of(history_done(document->history, i),
							   pou, rung);

		if (relation == STEP_EDIT)
			back = BACK_DONE;
		other = other || relation == STEP_OTHER;
	}
	return back == BACK_DONE && other ? BACK_OTHER : back;
}

static void take_back(LadderDocument *document, const struct step *step)
{
	for (guint i = step->change->len; i-- > 0;) {
		const struct change *change = step->change->pdata[i];

		record(document, change_new(change->kind, change->pou, change->at,
						     g_ptr_array_ref(change->after),
						     g_ptr_array_ref(change->before)));
	}
}

enum back ladder_document_give_back(LadderDocument *document, int pou, int rung,
				    guint64 place, const char *name)
{
	const int count = steps_since(document, place);
	const enum back back = judge(document, pou, rung, count);

	if (back != BACK_DONE)
		return back;
	ladder_document_begin(document, name, NULL);
	history_goes_back(document->history, place);
	for (int i = 0; i < count; i++) {
		const struct step *step = history_done(document->history, i);

		if (relation_of(step, pou, rung) == STEP_EDIT)
			take_back(document, step);
	}
	ladder_document_end(document);
	return back;
}

/* ---- files beside the document ---- */

int ladder_document_attach(LadderDocument *document, file_apply apply, const char *path,
			   const char *(*text)(gpointer file), gpointer file)
{
	const struct beside beside = { apply, text, path, file };

	if (!document->files)
		document->files = g_array_new(FALSE, FALSE, sizeof(struct beside));
	g_array_append_val(document->files, beside);
	return (int)document->files->len - 1;
}

void ladder_document_detach(LadderDocument *document, int file)
{
	g_array_index(document->files, struct beside, file) = (struct beside){ 0 };
	history_forget_file(document->history, file);
	tell_state(document);
}

void ladder_document_note(LadderDocument *document, int file, const char *name,
			  const char *key, gsize at, const char *before, const char *after)
{
	ladder_document_begin(document, name, key);
	history_add(document->history, change_new(CHANGE_FILE, file, at,
		one_text(before, strlen(before)),
		one_text(after, strlen(after))));
	ladder_document_end(document);
	read_again(document, file);
}

/* Does a POU, a type or an INCLUDE of the project come from there? */
bool ladder_document_includes(LadderDocument *document, const char *path)
{
	const struct project *project = ladder_document_project(document);
	char *folder = g_path_get_dirname(ladder_document_file(document));
	bool is = false;

	for (int i = 0; project && i < project->pou_count && !is; i++)
		is = project->pou[i].included && disk_same(project->pou[i].file, path);
	for (int i = 0; project && i < project->structure_count && !is; i++)
		is = disk_same(project->structure[i].file, path);
	for (int i = 0; project && i < project->used_count && !is; i++)
		is = disk_same(project->used[i], path);
	for (int i = 0; project && i < project->part_count && !is; i++) {
		const struct part *part = &project->part[i];
		char *file = part->kind == PART_INCLUDE ? g_canonicalize_filename(
			project_text(project, part->text), folder) : NULL;

		is = file && disk_same(file, path);
		g_free(file);
	}
	g_free(folder);
	return is;
}

static void add_file(GPtrArray *files, const char *path)
{
	if (path && *path && !g_ptr_array_find_with_equal_func(files, path, g_str_equal, NULL))
		g_ptr_array_add(files, g_strdup(path));
}

GPtrArray *ladder_document_files(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);
	char *folder = g_path_get_dirname(ladder_document_file(document));
	GPtrArray *files = g_ptr_array_new_with_free_func(g_free);

	for (int i = 0; project && i < project->pou_count; i++)
		if (project->pou[i].included)
			add_file(files, project->pou[i].file);
	for (int i = 0; project && i < project->used_count; i++)
		add_file(files, project->used[i]);
	for (int i = 0; project && i < project->part_count; i++) {
		const struct part *part = &project->part[i];
		char *file = part->kind == PART_INCLUDE ?
			     g_canonicalize_filename(project_text(project, part->text), folder) : NULL;

		add_file(files, file);
		g_free(file);
	}
	g_free(folder);
	return files;
}

/* ---- the file ---- */

static char *sum_of(const char *text, gsize len)
{
	return g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)text, len);
}

/* Digest of the file; NULL: unknown. */
static void set_sum(LadderDocument *document, char *sum)
{
	g_free(document->disk_sum);
	document->disk_sum = sum;
	document->disk = DISK_AS_READ;
	memset(&document->disk_seen, 0, sizeof(document->disk_seen));
}

static void set_path(LadderDocument *document, const char *path)
{
	char *copy = path ? g_canonicalize_filename(path, NULL) : NULL;

	g_free(document->path);
	document->path = copy;
	g_clear_pointer(&document->copied, g_free);
	ladder_document_set_from(document, NULL);
}

static bool fail(GError **error, GFileError code, const char *text, const char *path)
{
	g_set_error(error, G_FILE_ERROR, code, _("%s: %s"), path, text);
	return false;
}

/* Invalid bytes become U+FFFD, so the document differs from the file. */
static void open_bytes(LadderDocument *document, const char *path, const char *text,
		       gsize len)
{
	const char *bad = text;
	char *valid;

	if (g_utf8_validate_len(text, len, &bad)) {
		ladder_document_open_text(document, path, text, len, true);
		return;
	}
	valid = g_utf8_make_valid(text, (gssize)len);
	ladder_document_open_text(document, path, valid, strlen(valid), false);
	set_sum(document, sum_of(text, len));
	document->repaired = 1;
	for (const char *at = text; at < bad; at++)
		document->repaired += *at == '\n';
	g_free(valid);
}

bool ladder_document_open(LadderDocument *document, const char *path, GError **error)
{
	gsize len;
	char *text = disk_read(path, LIMIT_TEXT, &len, error);

	if (!text)
		return false;
	if (len >= strlen(CODE_MAGIC) && !memcmp(text, CODE_MAGIC, strlen(CODE_MAGIC))) {
		g_free(text);
		return fail(error, G_FILE_ERROR_INVAL,
			    _("is a code image; open the program that it was made "
			      "from"), path);
	}
	open_bytes(document, path, text, len);
	g_free(text);
	return true;
}

static void open_text(LadderDocument *document, const char *path, const char *original, const char *text, gsize len,
		      bool saved)
{
	document->repaired = 0;
	set_path(document, path);
	document->copied = original ? g_canonicalize_filename(original, NULL) : NULL;
	set_sum(document, saved ? sum_of(text, len) : NULL);
	take(document, text, len);
	if (!saved) {
		history_never_saved(document->history);
		tell_state(document);
	}
}

void ladder_document_open_text(LadderDocument *document, const char *path,
			       const char *text, gsize len, bool saved)
{
	open_text(document, path, NULL, text, len, saved);
}

void ladder_document_open_copy(LadderDocument *document, const char *original, const char *text, gsize len,
			       bool saved)
{
	open_text(document, NULL, original, text, len, saved);
}

bool ladder_document_needs_rung_file(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);
	bool drawn = false;

	if (document->text || !project || project->source_count != 1 || !project->source[0].plain)
		return false;
	for (int i = 0; i < project->pou_count; i++)
		drawn |= !project->pou[i].included && (project->pou[i].language == LANGUAGE_LD ||
						       project->pou[i].language == LANGUAGE_SFC);
	return drawn || project_has_head(project) || *project_view(project);
}

static void say_first(const struct diag_list *diags, GError **error)
{
	const struct diag *first = diag_first_error(diags);
	char *why = first ? diag_said_whole(first) : g_strdup("");

	g_set_error(error, G_IO_ERROR, G_IO_ERROR_INVALID_DATA, _("It cannot become a rung file: line %d: %s"),
		    first ? first->line : 0, why);
	g_free(why);
}

/* Plain IEC text as a rung file, and the project read from it, where the same words may mean
 * something else. Caller frees. Fails: NULL, and @error says why. */
static char *as_rung_file(LadderDocument *document, gsize *len, struct ladder **ladder, GError **error)
{
	struct project *project = ladder_project(document->ladder);
	struct diag_list *diags = g_new(struct diag_list, 1);
	char *text, *own;

	diag_init(diags);
	forget_plain(document);
	project->source[0].plain = false;
	text = ladder_document_text(document, len);
	project->source[0].plain = true;
	forget_plain(document);
	if (project->words.as_numbers) {
		own = plain_file_numbers(text, len);
		g_free(text);
		text = own;
	}
	*ladder = read_text(document, text, *len, diags);
	if (!*ladder) {
		say_first(diags, error);
		g_clear_pointer(&text, g_free);
	}
	g_free(diags);
	return text;
}

/* Earlier steps are of another kind of file: they cannot be undone here. */
static void become_rung_file(LadderDocument *document, struct ladder *ladder)
{
	count_version(document);
	take_ladder(document, ladder);
	g_hash_table_remove_all(document->list);
	history_restart(document->history);
	tell_whole(document);
	changed(document);
}

static bool changes_form(LadderDocument *document, const char *path)
{
	const struct project *project = document->text ? NULL : ladder_project(document->ladder);

	return project && project->source_count == 1 && project->source[0].plain &&
	       g_str_has_suffix(path, ".rung");
}

bool ladder_document_save(LadderDocument *document, const char *path, GError **error)
{
	struct ladder *ladder = NULL;
	gsize len;
	char *text;
	bool good;

	path = path ? path : document->path;
	g_return_val_if_fail(path != NULL, false);
	text = changes_form(document, path) ? as_rung_file(document, &len, &ladder, error) :
					      ladder_document_text(document, &len);
	good = text && disk_save(path, text, len, error);
	if (good) {
		set_path(document, path);
		set_sum(document, sum_of(text, len));
		document->repaired = 0;
		if (ladder)
			become_rung_file(document, g_steal_pointer(&ladder));
		history_mark_saved(document->history);
		tell_state(document);
	}
	ladder_free(ladder);
	g_free(text);
	return good;
}

/* The file is read again only if its time, size or inode changed. */
static bool looks_the_same(LadderDocument *document, const GStatBuf *about)
{
	const GStatBuf *seen = &document->disk_seen;
	const bool same = about->st_mtim.tv_sec == seen->st_mtim.tv_sec &&
		about->st_mtim.tv_nsec == seen->st_mtim.tv_nsec &&
		about->st_ino == seen->st_ino && about->st_size == seen->st_size;

	document->disk_seen = *about;
	return same;
}

/* A file that cannot be read counts as there, with unknown contents. */
static enum disk_state look_at_disk(LadderDocument *document)
{
	enum disk_state state = DISK_AS_READ;
	GStatBuf about = { 0 };
	char *text, *sum;
	gsize len;

	if (g_stat(document->path, &about) != 0)
		return DISK_GONE;
	if (looks_the_same(document, &about))
		return document->disk;
	text = disk_read(document->path, LIMIT_TEXT, &len, NULL);
	if (text) {
		sum = sum_of(text, len);
		state = strcmp(sum, document->disk_sum) ? DISK_OTHER : DISK_AS_READ;
		g_free(sum);
	}
	g_free(text);
	return state;
}

enum disk_state ladder_document_disk(LadderDocument *document)
{
	const enum disk_state before = document->disk;

	if (!document->path || !document->disk_sum)
		return DISK_AS_READ;
	document->disk = look_at_disk(document);
	if (document->disk == DISK_GONE) /* a file that appears again is always read */
		memset(&document->disk_seen, 0, sizeof(document->disk_seen));
	if ((document->disk == DISK_GONE) != (before == DISK_GONE))
		tell_state(document);
	return document->disk;
}

const char *ladder_document_disk_sum(LadderDocument *document)
{
	return document->disk_sum;
}

void ladder_document_restore(LadderDocument *document, const char *path, const char *sum,
			     const char *text, gsize len)
{
	ladder_document_open_text(document, path, text, len, false);
	set_sum(document, g_strdup(sum));
}

bool ladder_document_is_saved(LadderDocument *document)
{
	return history_is_saved(document->history) && document->disk != DISK_GONE;
}

int ladder_document_repaired(LadderDocument *document)
{
	return document->repaired;
}

/* ---- checks ---- */

static void copy_text(gpointer owner, struct checker_text *to)
{
	LadderDocument *document = owner;

	to->reader = ladder_document_reader(document);
	to->text = ladder_document_text(document, &to->len);
	to->file = g_intern_string(ladder_document_file(document));
	to->version = document->version;
}

static void checked(gpointer owner, bool read)
{
	LadderDocument *document = owner;
	struct checker *checker = document->checker;

	if (checker_version(checker) == document->version) {
		if (read)
			check_lists(document, ladder_project(checker_ladder(checker)),
				    checker_diags(checker));
		if (ladder_document_project(document))
			checker_place(checker, ladder_document_project(document));
	}
	g_signal_emit(document, signals[CHECKED], 0);
}

static const struct checker_how checks = { copy_text, checked };

void ladder_document_check_now(LadderDocument *document)
{
	checker_now(document->checker);
}

const struct diag_list *ladder_document_diags(LadderDocument *document)
{
	return checker_diags(document->checker);
}

struct ladder *ladder_document_checked(LadderDocument *document)
{
	return checker_ladder(document->checker);
}

/* ---- life ---- */

static void ladder_document_finalize(GObject *object)
{
	LadderDocument *document = LADDER_DOCUMENT(object);

	checker_free(document->checker);
	forget_plain(document);
	ladder_free(document->ladder);
	history_free(document->history);
	g_clear_pointer(&document->files, g_array_unref);
	g_hash_table_unref(document->list);
	g_free(document->text);
	g_free(document->from);
	g_free(document->copied);
	g_free(document->path);
	g_free(document->disk_sum);
	G_OBJECT_CLASS(ladder_document_parent_class)->finalize(object);
}

static void ladder_document_class_init(LadderDocumentClass *class)
{
	const GType type = G_TYPE_FROM_CLASS(class);
	const GSignalFlags flags = G_SIGNAL_RUN_LAST;

	G_OBJECT_CLASS(class)->finalize = ladder_document_finalize;
	signals[RUNGS_CHANGED] = g_signal_new("rungs-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 4, G_TYPE_INT, G_TYPE_INT, G_TYPE_INT,
		G_TYPE_INT);
	signals[VARIABLE_CHANGED] = g_signal_new("variable-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 3, G_TYPE_INT, G_TYPE_STRING, G_TYPE_STRING);
	signals[PROJECT_CHANGED] = g_signal_new("project-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 0);
	signals[LIST_CHANGED] = g_signal_new("list-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 1, G_TYPE_INT);
	signals[BOOKMARKS_CHANGED] = g_signal_new("bookmarks-changed", type, flags, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[CHECKED] = g_signal_new("checked", type, flags, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 0);
	signals[FILE_OPENED] = g_signal_new("file-opened", type, flags, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 1, G_TYPE_OBJECT);
	signals[STATE_CHANGED] = g_signal_new("state-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 0);
}

static void ladder_document_init(LadderDocument *document)
{
	document->history = history_new();
	document->list = g_hash_table_new_full(NULL, NULL, NULL, g_free);
	document->checker = checker_new(G_OBJECT(document), &checks);
	take_text(document, EMPTY_PROJECT, strlen(EMPTY_PROJECT));
	checker_later(document->checker);
}

LadderDocument *ladder_document_new(void)
{
	return g_object_new(LADDER_TYPE_DOCUMENT, NULL);
}
