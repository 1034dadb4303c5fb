/* SPDX-License-Identifier: MIT
 *
 * online_bar - see online_bar.h.
 */
#include "editor-gtk/window/online_bar.h"

#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/online/board_finder.h"
#include "editor-gtk/online/connect_dialog.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/messages.h"

#include "engine/scan/code.h"
#include "engine/scan/resource.h"

#include <string.h>
#include <sys/prctl.h>

static LadderBoardLink *link_of(struct online_bar *bar)
{
	return bar->core->link;
}

static bool is_on(struct online_bar *bar)
{
	return ladder_board_link_state(link_of(bar)) != LINK_OFF;
}

/* ---- questions of ssh ---- */

/* While an answer is typed, no core has it. */
static void question_answered(AdwMessageDialog *dialog, const char *answer, struct online_bar *bar)
{
	GtkWidget *entry = adw_message_dialog_get_extra_child(dialog);

	if (dialog != bar->question)
		return;
	bar->question = NULL;
	if (strcmp(answer, "cancel") == 0)
		ladder_board_link_answer(link_of(bar), NULL);
	else
		ladder_board_link_answer(link_of(bar), entry ?
					 gtk_editable_get_text(GTK_EDITABLE(entry)) : "yes");
	prctl(PR_SET_DUMPABLE, 1);
}

static void close_question(struct online_bar *bar)
{
	AdwMessageDialog *dialog = g_steal_pointer(&bar->question);

	if (!dialog)
		return;
	prctl(PR_SET_DUMPABLE, 1);
	gtk_window_destroy(GTK_WINDOW(dialog));
}

static void asks(LadderBoardLink *link, const char *question, gboolean yes_no,
		 struct online_bar *bar)
{
	AdwMessageDialog *dialog = ask_new(bar->core->window, yes_no ? _("Unknown board") :
		ladder_board_link_board(link), question, "answer", yes_no ? _("Connect") : _("OK"),
		yes_no ? ADW_RESPONSE_DEFAULT : ADW_RESPONSE_SUGGESTED);
	GtkWidget *entry;

	close_question(bar);
	bar->question = dialog;
	prctl(PR_SET_DUMPABLE, 0);
	if (yes_no) {
		adw_message_dialog_set_default_response(dialog, "cancel");
	} else {
		entry = ask_secret(question);
		adw_message_dialog_set_extra_child(dialog, entry);
	}
	core_connect(bar->core, dialog, "response", G_CALLBACK(question_answered), bar, 0);
	gtk_window_present(GTK_WINDOW(dialog));
}

/* ---- its text ---- */

enum same { SAME_UNKNOWN, SAME, SAME_ERRORS, SAME_CHANGED, SAME_OTHER, SAME_NONE };

static enum same compare_programs(struct online_bar *bar)
{
	const struct board_status *status = ladder_board_link_status(link_of(bar));

	if (!status)
		return SAME_UNKNOWN;
	if (!status_has_program(status))
		return SAME_NONE;
	if (!bar->has_identity)
		return SAME_ERRORS;
	if (memcmp(status->program, bar->identity, sizeof(bar->identity)) == 0)
		return SAME;
	return bar->was_same ? SAME_CHANGED : SAME_OTHER;
}

/* "garage · RUN · 2 forces". Caller frees. */
static char *state_text(struct online_bar *bar)
{
	const char *board = ladder_board_link_board(link_of(bar));
	const struct board_status *status = ladder_board_link_status(link_of(bar));
	GString *text = g_string_new(board);

	switch (ladder_board_link_state(link_of(bar))) {
	case LINK_CONNECTING:
		g_string_append_printf(text, " · %s", _("connecting…"));
		break;
	case LINK_LOST:
		g_string_append_printf(text, " · %s", _("connection lost, trying again"));
		break;
	case LINK_FAILED:
		g_string_append_printf(text, " · %s", _("not connected"));
		break;
	case LINK_OFF: case LINK_CONNECTED:
		break;
	}
	if (status)
		g_string_append_printf(text, " · %s", mode_word(status->mode));
	if (status && ladder_board_link_role(link_of(bar)) != ROLE_ENG)
		g_string_append_printf(text, " · %s", ladder_board_link_role(link_of(bar)) ==
				       ROLE_OPER ? _("you may operate") : _("you may look"));
	return g_string_free(text, FALSE);
}

static void show_label(GtkWidget *label, const char *text)
{
	if (strcmp(gtk_label_get_text(GTK_LABEL(label)), text) == 0)
		return;
	gtk_label_set_text(GTK_LABEL(label), text);
	tip_set(label, *text ? text : NULL);
	gtk_widget_set_visible(label, *text != '\0');
}

static void show_same(struct online_bar *bar)
{
	static const char *const texts[] = {
		[SAME_UNKNOWN] = "", [SAME] = N_("The board runs this program."),
		[SAME_ERRORS] = N_("This program has errors."),
		[SAME_CHANGED] = N_("Changed here, not downloaded."),
		[SAME_OTHER] = N_("The board runs another program."),
		[SAME_NONE] = N_("The board has no program."),
	};
	const enum same same = compare_programs(bar);

	if (same == SAME)
		bar->was_same = true;
	show_label(bar->same, said(texts[same]));
	style_set(bar->same, "warning", same == SAME_CHANGED || same == SAME_OTHER ||
		  same == SAME_ERRORS);
}

/* Why the program stands still, or why there is no connection. */
static const char *reason_of(struct online_bar *bar)
{
	const struct board_status *status = ladder_board_link_status(link_of(bar));

	return !status ? ladder_board_link_reason(link_of(bar)) :
	       status->mode == STATE_FAULT ? status->fault : status->stop;
}

static void show_reason(struct online_bar *bar)
{
	const struct board_status *status = ladder_board_link_status(link_of(bar));
	const enum link_state state = ladder_board_link_state(link_of(bar));
	const bool none = state == LINK_CONNECTED &&
			  ladder_board_link_role(link_of(bar)) == ROLE_NONE;

	show_label(bar->reason, none ? _("Your user on the board is in none of the groups "
		"ladder-view, ladder-oper, ladder-eng, so it may do nothing there. Add it to one "
		"of them and connect again.") : reason_of(bar));
	style_set(bar->reason, "error", !status || status->mode == STATE_FAULT);
	gtk_widget_set_visible(bar->again, state == LINK_FAILED || state == LINK_LOST || none);
}

static bool may(struct online_bar *bar, enum service service)
{
	return ladder_board_link_status(link_of(bar)) &&
	       ladder_board_link_may(link_of(bar), service);
}

static void tell_facts(struct online_bar *bar, int mode, enum role role)
{
	struct core *core = bar->core;

	core_with(core, WITH_OFFLINE, !is_on(bar));
	core_with(core, WITH_LINK, is_on(bar));
	core_with(core, WITH_ANSWER, ladder_board_link_state(link_of(bar)) == LINK_CONNECTED);
	core_with(core, WITH_MAY_RUN, mode == STATE_STOP && role == ROLE_ENG &&
		  status_has_program(ladder_board_link_status(link_of(bar))));
	core_with(core, WITH_MAY_STOP, mode == STATE_RUN && role == ROLE_ENG);
	core_with(core, WITH_MAY_RESET, mode == STATE_FAULT && role >= ROLE_OPER);
	core_with(core, WITH_MAY_DOWNLOAD, may(bar, SERVICE_DOWNLOAD));
	core_with(core, WITH_MAY_UPLOAD, may(bar, SERVICE_UPLOAD));
	if (is_on(bar)) { /* the keys of the simulation order the board */
		core_with(core, WITH_STOP, core->with & WITH_MAY_STOP);
		core_with(core, WITH_TIME, false);
	}
}

/* A button that the role does not allow says so. */
static void show_actions(struct online_bar *bar)
{
	const struct board_status *status = ladder_board_link_status(link_of(bar));
	const enum role role = ladder_board_link_role(link_of(bar));
	const int mode = status ? status->mode : -1;
	const char *why = status ? ladder_board_link_needs(link_of(bar), ROLE_ENG) : NULL;

	tell_facts(bar, mode, role);
	for (GtkWidget *at = gtk_widget_get_first_child(bar->buttons); at;
	     at = gtk_widget_get_next_sibling(at)) {
		const char *action = gtk_actionable_get_action_name(GTK_ACTIONABLE(at));

		tip_set(at, gtk_widget_get_sensitive(at) ||
			g_strcmp0(action, "win.online_disconnect") == 0 ? NULL : why);
		if (g_strcmp0(action, "win.online_run") == 0)
			gtk_widget_set_visible(at, mode == STATE_STOP);
		else if (g_strcmp0(action, "win.online_stop") == 0)
			/* The page Board stops a program of this editor. */
			gtk_widget_set_visible(at, mode == STATE_RUN && !core_is_own(bar->core));
		else if (g_strcmp0(action, "win.online_reset") == 0)
			gtk_widget_set_visible(at, mode == STATE_FAULT);
		else if (g_strcmp0(action, "win.online_disconnect") != 0)
			gtk_widget_set_visible(at, status != NULL);
	}
}

/* The log has each change of the state once. */
static void log_state(struct online_bar *bar, const char *text)
{
	const char *reason = reason_of(bar);
	char *whole = *reason ? g_strdup_printf(_("%s: %s"), text, reason) : g_strdup(text);

	/* board_bar logs a program of this editor. */
	if (is_on(bar) && !core_is_own(bar->core) && g_strcmp0(bar->said, whole) != 0)
		messages_log(bar->core->messages, LOG_COMMUNICATION, whole);
	g_free(bar->said);
	bar->said = whole;
}

static void show(struct online_bar *bar)
{
	const struct board_status *status = ladder_board_link_status(link_of(bar));
	char *text = state_text(bar);

	gtk_widget_set_visible(bar->bar, is_on(bar));
	show_label(bar->state, text);
	style_set(bar->state, "error", status && status->mode == STATE_FAULT);
	style_set(bar->state, "success", status && status->mode == STATE_RUN);
	show_same(bar);
	show_reason(bar);
	show_actions(bar);
	log_state(bar, text);
	if (gtk_toggle_button_get_active(bar->mode) != is_on(bar))
		gtk_toggle_button_set_active(is_on(bar) ? bar->mode : bar->edit_mode, TRUE);
	g_free(text);
}

static void state_changed(struct online_bar *bar)
{
	const enum link_state state = ladder_board_link_state(link_of(bar));

	if (state == LINK_CONNECTING)
		bar->was_same = false;
	if (state != LINK_CONNECTING)
		close_question(bar);
	if (state == LINK_CONNECTED && g_strcmp0(ladder_board_link_where(link_of(bar)),
						 ladder_board_run_where(bar->core->board)) != 0)
		board_recent_add(ladder_board_link_where(link_of(bar)));
	show(bar);
}

/* The identity of a program that has errors is not known. */
static void checked(struct online_bar *bar)
{
	struct ladder *ladder = ladder_document_checked(bar->core->document);
	const struct program *program = ladder && !ladder_document_diags(bar->core->document)->errors ?
		ladder_program(ladder) : NULL;

	bar->has_identity = program != NULL;
	if (program)
		code_identity(program, bar->identity);
	if (is_on(bar))
		show(bar);
}

static void failed(LadderBoardLink *link, const char *service, const char *text,
		   struct online_bar *bar)
{
	char *line = g_strdup_printf(_("%s: %s: %s"), ladder_board_link_board(link), service, text);

	messages_log_failed(bar->core->messages, line, text);
	g_free(line);
}

/* What the status bar said is true no more. */
static void mended(LadderBoardValues *values, const char *why, struct online_bar *bar)
{
	(void)values;
	messages_untell(bar->core->messages, why);
}

/* ---- orders ---- */

static void ordered(gpointer data, struct board_answer *answer)
{
	struct online_bar *bar = data;

	if (answer->end != DESK_GOOD)
		messages_banner(bar->core->messages, LOG_COMMUNICATION, answer->text, NULL, NULL);
}

/* What a person was asked, and what the board did then. */
struct order { enum mode_wish wish; struct expect expect; };

static void order_answered(AdwMessageDialog *dialog, const char *answer, struct online_bar *bar)
{
	const struct order *order = g_object_get_data(G_OBJECT(dialog), "order");

	if (strcmp(answer, "do") == 0)
		ladder_board_link_mode(link_of(bar), &order->expect, order->wish, bar->core->window,
				       ordered, bar);
}

/* Each of them moves a machine, so it is asked for. */
static void order(struct online_bar *bar, enum mode_wish wish)
{
	static const struct { const char *heading, *body, *button; } texts[] = {
		[MODE_STOP] = { N_("Stop the program on “%s”?"),
				N_("The outputs get their safe values."), N_("Stop") },
		[MODE_WARM] = { N_("Run the program on “%s”?"),
				N_("It begins with retained values and drives the outputs."),
				N_("Run") },
		[MODE_RESET] = { N_("Reset the fault of “%s”?"),
				 N_("The program begins with retained values and drives the "
				    "outputs."), N_("Reset") },
	};
	struct order *order = g_new0(struct order, 1);
	char *heading = g_strdup_printf(_(texts[wish].heading), ladder_board_link_board(link_of(bar)));
	AdwMessageDialog *dialog = ask_new(bar->core->window, heading, _(texts[wish].body), "do",
		_(texts[wish].button), wish == MODE_STOP ? ADW_RESPONSE_DESTRUCTIVE :
							   ADW_RESPONSE_SUGGESTED);

	order->wish = wish;
	order->expect = ladder_board_link_expect(link_of(bar));
	g_object_set_data_full(G_OBJECT(dialog), "order", order, g_free);
	core_connect(bar->core, dialog, "response", G_CALLBACK(order_answered), bar, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(heading);
}

/* ---- connecting ---- */

static void connect_to(struct online_bar *bar, const char *where)
{
	char *why = NULL;

	if (ladder_sim_is_on(bar->core->sim) && !is_on(bar))
		core_do(bar->core, "win.sim_mode"); /* ends the simulation */
	if (!ladder_board_link_connect(link_of(bar), where, &why))
		messages_warn(bar->core->messages, why);
	g_free(why);
}

void online_bar_share(struct online_bar *bar, struct online_bar *with)
{
	const char *where = ladder_board_link_where(link_of(bar));

	if (!is_on(bar))
		return;
	if (g_str_has_prefix(where, "serial:"))
		ladder_board_link_disconnect(link_of(bar));
	connect_to(with, where);
}

static void chosen(GtkWidget *dialog, const char *where, struct online_bar *bar)
{
	(void)dialog;
	bar->chosen = true;
	connect_to(bar, where);
}

static void closed(struct online_bar *bar)
{
	if (!bar->chosen)
		show(bar); /* the switch goes back */
}

/* The socket of a program that ran on this machine is gone. NULL: none. */
static const char *last_place(struct online_bar *bar)
{
	const char *where = ladder_board_link_where(link_of(bar));

	return where && g_str_has_prefix(where, "unix:/") &&
	       !g_file_test(where + strlen("unix:"), G_FILE_TEST_EXISTS) ? NULL : where;
}

/* @where: what the line has at first; NULL: nothing. */
static void ask_board(struct online_bar *bar, const char *where)
{
	GtkWidget *dialog = ladder_connect_dialog_new(bar->core->window, where);

	bar->chosen = false;
	core_connect(bar->core, dialog, "chosen", G_CALLBACK(chosen), bar, 0);
	core_connect(bar->core, dialog, "unrealize", G_CALLBACK(closed), bar, G_CONNECT_SWAPPED);
	gtk_window_present(GTK_WINDOW(dialog));
}

void online_bar_choose(struct online_bar *bar, const char *where)
{
	const enum link_state state = ladder_board_link_state(link_of(bar));
	const bool same = is_on(bar) && g_strcmp0(ladder_board_link_where(link_of(bar)), where) == 0;

	if (same && (state == LINK_CONNECTED || state == LINK_CONNECTING))
		return;
	if (same)
		ladder_board_link_reconnect(link_of(bar));
	else if (is_on(bar) || ladder_sim_is_on(bar->core->sim))
		ask_board(bar, where);
	else
		connect_to(bar, where);
}

static void mode_toggled(struct online_bar *bar)
{
	const bool wanted = gtk_toggle_button_get_active(bar->mode);

	if (wanted && !is_on(bar))
		ask_board(bar, last_place(bar));
	else if (!wanted && is_on(bar))
		ladder_board_link_disconnect(link_of(bar));
}

/* ---- commands ---- */

/* The keys of the simulation order the board. */
static bool do_as_simulated(struct online_bar *bar, enum verb verb)
{
	const struct board_status *status = ladder_board_link_status(link_of(bar));

	if (!is_on(bar))
		return false;
	switch ((int)verb) {
	case VERB_sim_run:
		if (status && status->mode == STATE_RUN)
			messages_tell(bar->core->messages, _("The board runs already"));
		else
			core_do(bar->core, status && status->mode == STATE_FAULT ?
				"win.online_reset" : "win.online_run");
		return true;
	case VERB_sim_stop: core_do(bar->core, "win.online_stop"); return true;
	case VERB_sim_mode: ladder_board_link_disconnect(link_of(bar)); return true;
	case VERB_sim_scan: case VERB_sim_cold: case VERB_sim_warm:
		messages_tell(bar->core->messages, _("This works only in the simulation"));
		return true;
	default: return false;
	}
}

bool online_bar_do(struct online_bar *bar, enum verb verb)
{
	switch ((int)verb) {
	case VERB_online_connect: ask_board(bar, last_place(bar)); return true;
	case VERB_online_reconnect: ladder_board_link_reconnect(link_of(bar)); return true;
	case VERB_online_disconnect: ladder_board_link_disconnect(link_of(bar)); return true;
	case VERB_online_run: order(bar, MODE_WARM); return true;
	case VERB_online_stop: order(bar, MODE_STOP); return true;
	case VERB_online_reset: order(bar, MODE_RESET); return true;
	case VERB_online_compare: online_move_compare(&bar->move); return true;
	case VERB_online_download: online_move_download(&bar->move); return true;
	case VERB_online_upload: online_move_upload(&bar->move); return true;
	default: return do_as_simulated(bar, verb);
	}
}

/* ---- life ---- */

static void add_button(struct online_bar *bar, const char *label, const char *action,
		       const char *class)
{
	GtkWidget *button = gtk_button_new_with_label(label);

	gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
	if (class)
		gtk_widget_add_css_class(button, class);
	gtk_box_append(GTK_BOX(bar->buttons), button);
}

static GtkWidget *label_new(void)
{
	GtkWidget *label = gtk_label_new("");

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_widget_set_visible(label, FALSE);
	return label;
}

static void make_bar(struct online_bar *bar)
{
	GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 12);

	bar->bar = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
	gtk_widget_add_css_class(bar->bar, "online-bar");
	bar->state = label_new();
	gtk_widget_add_css_class(bar->state, "heading");
	bar->same = label_new();
	gtk_widget_set_hexpand(bar->same, TRUE);
	bar->buttons = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	gtk_widget_set_hexpand(bar->buttons, TRUE);
	gtk_widget_set_halign(bar->buttons, GTK_ALIGN_END);
	add_button(bar, _("Run"), "win.online_run", NULL);
	add_button(bar, _("Stop"), "win.online_stop", NULL);
	add_button(bar, _("Reset"), "win.online_reset", NULL);
	add_button(bar, _("Compare"), "win.online_compare", NULL);
	add_button(bar, _("Upload…"), "win.online_upload", NULL);
	add_button(bar, _("Download…"), "win.online_download", "suggested-action");
	add_button(bar, _("Disconnect"), "win.online_disconnect", NULL);
	bar->again = gtk_button_new_with_label(_("Connect again"));
	gtk_actionable_set_action_name(GTK_ACTIONABLE(bar->again), "win.online_reconnect");
	gtk_box_append(GTK_BOX(line), bar->state);
	gtk_box_append(GTK_BOX(line), bar->same);
	gtk_box_append(GTK_BOX(line), bar->again);
	gtk_box_append(GTK_BOX(line), bar->buttons);
	bar->reason = label_new();
	gtk_label_set_wrap(GTK_LABEL(bar->reason), TRUE);
	gtk_label_set_ellipsize(GTK_LABEL(bar->reason), PANGO_ELLIPSIZE_NONE);
	gtk_box_append(GTK_BOX(bar->bar), line);
	gtk_box_append(GTK_BOX(bar->bar), bar->reason);
	gtk_widget_set_visible(bar->bar, FALSE);
	gtk_box_append(bar->place, bar->bar);
}

void online_bar_init(struct online_bar *bar, struct core *core, struct compare *compare)
{
	bar->core = core;
	make_bar(bar);
	online_move_init(&bar->move, core, compare);
	core_connect(core, core->link, "state-changed", G_CALLBACK(state_changed), bar,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->link, "status", G_CALLBACK(show), bar, G_CONNECT_SWAPPED);
	core_connect(core, core->link, "asks", G_CALLBACK(asks), bar, 0);
	core_connect(core, core->link, "failed", G_CALLBACK(failed), bar, 0);
	core_connect(core, core->values, "mended", G_CALLBACK(mended), bar, 0);
	core_connect(core, core->document, "checked", G_CALLBACK(checked), bar, G_CONNECT_SWAPPED);
	core_connect(core, bar->mode, "toggled", G_CALLBACK(mode_toggled), bar, G_CONNECT_SWAPPED);
	checked(bar);
	show(bar);
}

void online_bar_clear(struct online_bar *bar)
{
	online_move_clear(&bar->move);
	g_clear_pointer(&bar->said, g_free);
}
