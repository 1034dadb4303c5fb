/* SPDX-License-Identifier: MIT
 *
 * compare - see compare.h.
 */
#include "editor-gtk/window/compare.h"

#include "editor-gtk/document/revision.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/compare_dialog.h"
#include "editor-gtk/panels/compare_view.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/exchange.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

/* Takes over both sides. @newer NULL: the document. */
static void show(struct compare *compare, struct compare_side *older, struct compare_side *newer)
{
	LadderCompareView *view = LADDER_COMPARE_VIEW(tabs_show_widget(compare->core->tabs,
								       "compare"));

	ladder_compare_view_show(view, older, newer);
	ladder_compare_view_enter(view);
}

void compare_with(struct compare *compare, struct compare_side *older)
{
	show(compare, older, NULL);
}

/* ---- files ---- */

static struct compare_side side_of(const char *path)
{
	return (struct compare_side){ .name = g_path_get_basename(path), .path = g_strdup(path) };
}

void compare_files(struct compare *compare, const char *older, const char *newer)
{
	struct compare_side a = side_of(older), b = side_of(newer);

	if (strcmp(a.name, b.name) == 0) { /* the folders tell which is which */
		g_free(a.name);
		g_free(b.name);
		a.name = g_strdup(older);
		b.name = g_strdup(newer);
	}
	show(compare, &a, &b);
}

static void saved(GtkWindow *dialog, struct compare *compare)
{
	const char *path = ladder_document_path(compare->core->document);
	struct compare_side older = side_of(path);
	char *name = g_strdup_printf(_("%s, as saved"), older.name);

	(void)dialog;
	g_free(older.name);
	older.name = name;
	show(compare, &older, NULL);
}

static void ask_file(struct compare *compare, const char *title, const char *accept,
		     void (*response)(GtkNativeDialog *chooser, int response,
				      struct compare *compare))
{
	struct core *core = compare->core;
	GtkFileChooserNative *chooser = ask_rung_file(core->window, core->document, title,
		GTK_FILE_CHOOSER_ACTION_OPEN, accept);

	exchange_add_filter(GTK_FILE_CHOOSER(chooser), false, false);
	core_connect(core, chooser, "response", G_CALLBACK(response), compare, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

static void file_response(GtkNativeDialog *chooser, int response, struct compare *compare)
{
	char *path = ask_take_path(chooser, response);
	struct compare_side older;

	if (!path)
		return;
	older = side_of(path);
	show(compare, &older, NULL);
	g_free(path);
}

static void file(GtkWindow *dialog, struct compare *compare)
{
	(void)dialog;
	ask_file(compare, _("Compare with"), _("Compare"), file_response);
}

static void newer_response(GtkNativeDialog *chooser, int response, struct compare *compare)
{
	char *path = ask_take_path(chooser, response);

	if (path && compare->older)
		compare_files(compare, compare->older, path);
	g_clear_pointer(&compare->older, g_free);
	g_free(path);
}

static void older_response(GtkNativeDialog *chooser, int response, struct compare *compare)
{
	g_free(compare->older);
	compare->older = ask_take_path(chooser, response);
	if (compare->older)
		ask_file(compare, _("The newer file"), _("Compare"), newer_response);
}

void compare_ask_files(struct compare *compare)
{
	ask_file(compare, _("The older file"), _("Next"), older_response);
}

static void files(GtkWindow *dialog, struct compare *compare)
{
	(void)dialog;
	compare_ask_files(compare);
}

/* ---- revisions ---- */

static void forget(struct compare *compare)
{
	if (compare->cancel)
		g_cancellable_cancel(compare->cancel);
	g_clear_object(&compare->cancel);
}

static void take_revision(gpointer data, struct compare_side *side, const char *why)
{
	struct compare *compare = data;

	if (side)
		show(compare, side, NULL);
	else
		messages_warn(compare->core->messages, why);
	forget(compare);
}

static void revision(GtkWindow *dialog, const char *hash, const char *then, const char *name,
		     struct compare *compare)
{
	(void)dialog;
	forget(compare);
	compare->cancel = g_cancellable_new();
	revision_read(ladder_document_path(compare->core->document), hash, then, name,
		      compare->cancel, take_revision, compare);
}

void compare_ask(struct compare *compare)
{
	struct core *core = compare->core;
	GtkWidget *dialog = ladder_compare_dialog_new(core->window, core->document);

	core_connect(core, dialog, "saved", G_CALLBACK(saved), compare, 0);
	core_connect(core, dialog, "file", G_CALLBACK(file), compare, 0);
	core_connect(core, dialog, "files", G_CALLBACK(files), compare, 0);
	core_connect(core, dialog, "revision", G_CALLBACK(revision), compare, 0);
	gtk_window_present(GTK_WINDOW(dialog));
}

void compare_step(struct compare *compare, bool back)
{
	GtkWidget *view = tabs_find_widget(compare->core->tabs, "compare");

	if (!view) {
		messages_tell(compare->core->messages, _("Nothing is compared. Choose Compare… "
							 "first."));
		return;
	}
	if (gtk_widget_get_mapped(view)) {
		ladder_compare_view_step(LADDER_COMPARE_VIEW(view), back);
		return;
	}
	tabs_show_widget(compare->core->tabs, "compare");
	ladder_compare_view_enter(LADDER_COMPARE_VIEW(view));
}

void compare_init(struct compare *compare, struct core *core)
{
	*compare = (struct compare){ .core = core };
}

void compare_clear(struct compare *compare)
{
	forget(compare);
	g_clear_pointer(&compare->older, g_free);
}
