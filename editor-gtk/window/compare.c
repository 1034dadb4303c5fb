/* SPDX-License-Identifier: MIT
 *
 * compare - see compare.h.
 */
#include "editor-gtk/window/compare.h"

#include "editor-gtk/document/git_log.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/compare_dialog.h"
#include "editor-gtk/panels/compare_view.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/exchange.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

/* Takes the texts of @older. */
static void show(struct compare *compare, struct compare_side older)
{
	LadderCompareView *view = LADDER_COMPARE_VIEW(tabs_show_widget(compare->core->tabs,
								       "compare"));

	ladder_compare_view_show(view, &older);
	ladder_compare_view_enter(view);
}

/* ---- versions ---- */

static void saved(GtkWindow *dialog, struct compare *compare)
{
	const char *path = ladder_document_path(compare->core->document);
	char *base = g_path_get_basename(path);

	(void)dialog;
	show(compare, (struct compare_side){ g_strdup_printf(_("%s, as saved"), base),
					     g_strdup(path), NULL, 0 });
	g_free(base);
}

static void file_response(GtkNativeDialog *chooser, int response, struct compare *compare)
{
	char *path = ask_take_path(chooser, response);

	if (path)
		show(compare, (struct compare_side){ g_path_get_basename(path), path, NULL,
						     0 });
}

static void file(GtkWindow *dialog, struct compare *compare)
{
	struct core *core = compare->core;
	GtkFileChooserNative *chooser = ask_rung_file(core->window, core->document,
		_("Compare with"), GTK_FILE_CHOOSER_ACTION_OPEN, _("Compare"));

	(void)dialog;
	exchange_add_filter(GTK_FILE_CHOOSER(chooser), false, false);
	core_connect(core, chooser, "response", G_CALLBACK(file_response), compare, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

static void forget(struct compare *compare)
{
	if (compare->cancel)
		g_cancellable_cancel(compare->cancel);
	g_clear_object(&compare->cancel);
	g_clear_pointer(&compare->name, g_free);
}

static void take_text(gpointer data, char *text, gsize len, const char *why)
{
	struct compare *compare = data;

	if (text)
		show(compare, (struct compare_side){ g_strdup(compare->name),
			g_strdup(ladder_document_path(compare->core->document)), text, len });
	else
		messages_warn(compare->core->messages, why);
	forget(compare);
}

static void revision(GtkWindow *dialog, const char *hash, const char *name,
		     struct compare *compare)
{
	(void)dialog;
	forget(compare);
	compare->cancel = g_cancellable_new();
	compare->name = g_strdup(name);
	git_log_show(ladder_document_path(compare->core->document), hash, compare->cancel,
		     take_text, compare);
}

void compare_ask(struct compare *compare)
{
	struct core *core = compare->core;
	GtkWidget *dialog = ladder_compare_dialog_new(core->window, core->document);

	core_connect(core, dialog, "saved", G_CALLBACK(saved), compare, 0);
	core_connect(core, dialog, "file", G_CALLBACK(file), compare, 0);
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
}
