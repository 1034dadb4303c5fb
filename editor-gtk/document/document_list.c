/* SPDX-License-Identifier: MIT
 *
 * document_list - the texts of POUs that a person writes as text: instruction lists.
 *
 * One that cannot be read stands beside the project until it can, and is saved with it.
 */
#include "editor-gtk/document/document_inside.h"
#include "editor-gtk/document/text_lines.h"

#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

/* Spans of the POUs, for the lists that stand beside the project. */
struct pou_spans {
	struct text_span *span;
	int count;
};

static void take_pou(void *context, const struct text_span *span)
{
	struct pou_spans *spans = context;

	if (span->part == TEXT_POU && span->number < spans->count)
		spans->span[span->number] = *span;
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
	const struct project *project = ladder_document_project(document);
	struct pou_spans spans = { 0 };
	char *text;
	gsize unused;

	len = len ? len : &unused;
	if (document->text) {
		*len = document->text_len;
		return g_memdup2(document->text, document->text_len + 1);
	}
	spans.count = project->pou_count;
	spans.span = g_new0(struct text_span, spans.count + 1);
	text = ladder_outline(document->ladder, len, take_pou, &spans);
	if (!text)
		g_error("out of memory");
	/* From the last to the first: a replacement moves what is behind it. */
	for (int i = spans.count - 1; i >= 0; i--) {
		const char *list = g_hash_table_lookup(document->list,
						       GINT_TO_POINTER(i));

		if (list) {
			char *more = with_list(text, &spans.span[i], list);

			free(text);
			text = strdup(more);
			g_free(more);
		}
	}
	g_free(spans.span);
	*len = strlen(text);

	char *copy = g_strdup(text);

	free(text);
	return copy;
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

/* ---- where somebody types ---- */

/* What stands before and behind a list, as of a version of the document: a key does not
 * write thousands of rungs again. */
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

static struct list_place *place_kept(LadderDocument *document, int pou)
{
	struct list_place *place = g_object_get_data(G_OBJECT(document), "list-place");

	return place && place->pou == pou && place->version == document->version ? place :
	       NULL;
}

void document_forget_place(LadderDocument *document)
{
	g_object_set_data(G_OBJECT(document), "list-place", NULL);
}

/* Borrowed until the document changes. */
static struct list_place *place_of(LadderDocument *document, int pou)
{
	struct list_place *place = place_kept(document, pou);
	struct pou_spans spans;
	char *plain;

	if (place)
		return place;
	plain = outline(document->ladder, &spans);
	place = g_new0(struct list_place, 1);
	place->pou = pou;
	place->version = document->version;
	place->head = g_strndup(plain, spans.span[pou].at);
	place->tail = g_strdup(plain + spans.span[pou].at + spans.span[pou].len);
	g_object_set_data_full(G_OBJECT(document), "list-place", place, place_free);
	free(plain);
	g_free(spans.span);
	return place;
}

/* ---- one POU, and nothing beside it ---- */

/* @ends: of the word with END_ before it. */
static bool is_pou_word(const struct token *token, bool ends)
{
	const size_t skip = ends ? strlen("END_") : 0;

	if (token->kind != TOKEN_NAME || token->len <= skip ||
	    (ends && g_ascii_strncasecmp(token->text, "END_", skip) != 0))
		return false;
	for (int i = 0; i <= POU_SUBROUTINE; i++) {
		const char *word = pou_word((enum pou_kind)i);

		if (strlen(word) == token->len - skip &&
		    g_ascii_strncasecmp(word, token->text + skip, token->len - skip) == 0)
			return true;
	}
	return false;
}

/* A text that begins with the word of a POU and ends with the only word that ends one. */
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

/* All but POU @pou is as it was: there is no POU more in its text, nor none. */
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

/* A list that can be read goes into the project, another one stands beside it. */
void document_apply_list(LadderDocument *document, int pou, const char *text)
{
	struct list_place *place = place_of(document, pou);
	char *whole = g_strconcat(place->head, text, place->tail, NULL);
	struct ladder *ladder = document_read(document, whole, strlen(whole), NULL);

	g_free(whole);
	place->version = document->version + 1; /* document_changed() follows */
	g_free(place->typed);
	place->typed = g_strdup(text);
	if (ladder && ladder_project(ladder)->pou_count ==
			      ladder_document_project(document)->pou_count &&
	    (is_plainly_one(text) || same_beside(ladder, place))) {
		document_take_ladder(document, ladder);
		g_hash_table_remove(document->list, GINT_TO_POINTER(pou));
		document_tell_whole(document);
	} else {
		ladder_free(ladder);
		g_hash_table_insert(document->list, GINT_TO_POINTER(pou),
				    g_strdup(text));
		document_tell_list(document, pou);
	}
}

/* The one of the first POU that has one. */
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

/* The line where the text of POU @pou begins, when no list stands before it. */
static int first_line(LadderDocument *document, int pou)
{
	struct pou_spans spans;
	char *text = outline(document->ladder, &spans);
	int line = 1;

	for (gsize i = 0; i < spans.span[pou].at; i++)
		line += text[i] == '\n';
	free(text);
	g_free(spans.span);
	return line;
}

void document_check_lists(LadderDocument *document, const struct project *read,
			  struct diag_list *diags)
{
	const struct project *project = ladder_document_project(document);
	const int pou = first_list(document);
	const bool fewer = project && read->pou_count < project->pou_count;
	const bool more = project && read->pou_count > project->pou_count;
	struct diag place = { .file = g_intern_string(document_file(document)) };

	if (pou < 0 || !project)
		return;
	place.pou = g_intern_string(project_text(project, project->pou[pou].name));
	place.id = fewer ? DIAG_EXPECTED : DIAG_MISPLACED;
	place.line = more ? read->pou[pou + 1].line : first_line(document, pou);
	diag_add(diags, place, "%s", fewer ? "PROGRAM" : more ?
		 project_text(read, read->pou[pou + 1].name) : "");
}

char *ladder_document_list(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	const char *list = g_hash_table_lookup(document->list, GINT_TO_POINTER(pou));
	struct pou_spans spans = { 0 };
	char *text, *out;
	gsize len;

	if (list)
		return g_strdup(list);
	if (!project || pou < 0 || pou >= project->pou_count)
		return NULL;
	spans.count = project->pou_count;
	spans.span = g_new0(struct text_span, spans.count);
	text = ladder_outline(document->ladder, &len, take_pou, &spans);
	out = g_strndup(text + spans.span[pou].at, spans.span[pou].len);
	free(text);
	g_free(spans.span);
	return out;
}

/* Lists beside the project may have other lengths than what they stand for. */
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

/* Not as the file would say it, but as it was typed, if that is known: it is the same. */
static char *list_before(LadderDocument *document, int pou)
{
	const struct list_place *place = place_kept(document, pou);

	return place && place->typed ? g_strdup(place->typed) :
	       ladder_document_list(document, pou);
}

bool ladder_document_put_list(LadderDocument *document, int pou, const char *text)
{
	char *before = list_before(document, pou);
	char *name = document_pou_name(document, pou);
	bool same = before && strcmp(before, text) == 0;

	if (before && !same && !document->fixed) {
		ladder_document_begin(document, _("Type text"), NULL);
		document_record(document, change_new(CHANGE_LIST, pou, 0,
					    document_one_text(before, strlen(before)),
					    document_one_text(text, strlen(text))));
		document_follow_name(document, pou, name);
		ladder_document_end(document);
	}
	g_free(name);
	g_free(before);
	return before;
}
