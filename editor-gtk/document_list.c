/* SPDX-License-Identifier: MIT
 *
 * document_list - the texts of POUs that a person writes as text: instruction lists.
 *
 * One that cannot be read stands beside the project until it can, and is saved with it.
 */
#include "editor-gtk/document_inside.h"

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

/* A list that can be read goes into the project, another one stands beside it. */
void document_apply_list(LadderDocument *document, int pou, const char *text)
{
	struct project *project = ladder_project(document->ladder);
	struct pou_spans spans = { NULL, project->pou_count };
	const int count = project->pou_count;
	gsize len;
	char *plain, *whole;

	spans.span = g_new0(struct text_span, count + 1);
	plain = ladder_outline(document->ladder, &len, take_pou, &spans);
	whole = with_list(plain, &spans.span[pou], text);
	free(plain);
	g_free(spans.span);
	if (document_take_text(document, whole, strlen(whole), false, NULL) &&
	    ladder_project(document->ladder)->pou_count == count) {
		g_hash_table_remove(document->list, GINT_TO_POINTER(pou));
		document_tell_whole(document);
	} else {
		g_hash_table_insert(document->list, GINT_TO_POINTER(pou),
				    g_strdup(text));
		document_tell_list(document, pou);
	}
	g_free(whole);
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

bool ladder_document_put_list(LadderDocument *document, int pou, const char *text)
{
	char *before = ladder_document_list(document, pou);
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
