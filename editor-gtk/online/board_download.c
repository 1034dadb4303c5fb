/* SPDX-License-Identifier: MIT
 *
 * board_download - see board_download.h. The session's thread sends the bytes
 * (runtime/online/send.h); progress and the wish to stop are two numbers that both threads see.
 */
#include "editor-gtk/online/board_download.h"

#include "editor-gtk/kit/i18n.h"

#include "engine/scan/carry.h"
#include "online/send.h"

#include <string.h>

#define LOOK_MS 100        /* between two looks at the progress               */

/* What the thread sends. */
struct sending {
	gatomicrefcount count;
	LadderBoardDownload *download; /* main thread only                     */
	struct board_program *program;
	gint done, stop;       /* bytes that the board has; a wish to stop     */
	bool all;              /* every byte                                   */
	struct sent sent;
};

struct _LadderBoardDownload {
	GObject parent;
	LadderBoardLink *link;
	struct sending *sending;
	struct expect expect;  /* what runs there when it begins               */
	enum download_state state;
	char *why;
	bool needs_restart;
	GPtrArray *losses;
	guint more, timer;
};

G_DEFINE_FINAL_TYPE(LadderBoardDownload, ladder_board_download, G_TYPE_OBJECT)

static guint changed_signal;

static void set_state(LadderBoardDownload *download, enum download_state state, const char *why)
{
	download->state = state;
	g_free(download->why);
	download->why = g_strdup(why);
	if (state != DOWNLOAD_SENDS)
		g_clear_handle_id(&download->timer, g_source_remove);
	g_signal_emit(download, changed_signal, 0);
}

static void fail(LadderBoardDownload *download, const struct board_answer *answer)
{
	char *text;

	if (answer->end == DESK_GONE)
		text = g_strdup_printf(_("%s. The board goes on with its program. Download "
					 "again when it is connected: it goes on where this "
					 "ended."), answer->text);
	else
		text = g_strdup_printf(_("%s. The board goes on with its program."),
				       answer->text);
	set_state(download, DOWNLOAD_FAILED, text);
	g_free(text);
}

/* ---- sending ---- */

static void sending_unref(gpointer data)
{
	struct sending *sending = data;

	if (!g_atomic_ref_count_dec(&sending->count))
		return;
	board_program_unref(sending->program);
	g_free(sending);
}

/* In the thread. */
static bool go_on(void *context, uint32_t done)
{
	struct sending *sending = context;

	g_atomic_int_set(&sending->done, (gint)done);
	return !g_atomic_int_get(&sending->stop);
}

static enum desk_end send_all(struct desk *desk, gpointer data)
{
	struct sending *sending = data;

	sending->sent = (struct sent){ .go_on = go_on, .context = sending };
	return send_program(desk, &sending->program->stored, sending->all, &sending->sent);
}

static void sent(gpointer data, struct board_answer *answer);

static void begin(LadderBoardDownload *download)
{
	g_atomic_ref_count_inc(&download->sending->count);
	ladder_board_link_work(download->link, send_all, download, sent, download->sending,
			       sending_unref);
}

/* ---- the changes that it would make ---- */

static char *loss_text(uint8_t reason, const char *name)
{
	static const char *const texts[] = {
		[CARRY_GONE] = N_("“%s” is not in the new program; its value is lost"),
		[CARRY_TYPE] = N_("“%s” has another type; it starts with its initial value"),
		[CARRY_BLOCK] = N_("“%s” is an instance of another block; it starts anew"),
		[CARRY_TEXT] = N_("“%s” has less room; it starts with its initial value"),
		[CARRY_FORCE] = N_("“%s” is forced; the force ends"),
	};
	const char *text = reason < G_N_ELEMENTS(texts) && texts[reason] ? texts[reason] :
			   N_("“%s” changes");

	return g_strdup_printf(_(text), name);
}

static void take_losses(LadderBoardDownload *download, struct wire_reader *in)
{
	uint32_t count, told;

	download->needs_restart = !wire_u8(in);
	wire_bytes(in, 32);
	count = wire_u32(in);
	told = wire_u32(in);
	for (uint32_t i = 0; i < told && !in->failed; i++) {
		const uint8_t reason = wire_u8(in);
		char name[WIRE_TEXT_MOST + 1], *valid;

		wire_copy_text(in, name, sizeof(name));
		if (reason == CARRY_NEW)
			continue; /* loses nothing */
		valid = g_utf8_make_valid(name, -1);
		g_ptr_array_add(download->losses, loss_text(reason, valid));
		g_free(valid);
	}
	download->more = count > told ? count - told : 0;
}

static void verified(gpointer data, struct board_answer *answer)
{
	LadderBoardDownload *download = data;

	if (download->state != DOWNLOAD_SENDS)
		return; /* cancelled */
	if (answer->end == DESK_REFUSED && answer->refusal == REFUSAL_NOT_WHOLE &&
	    download->sending->sent.copied && !download->sending->all) {
		/* Another program runs by now, or two blocks had the same sums. */
		download->sending->all = true;
		begin(download);
		return;
	}
	if (answer->end != DESK_GOOD) {
		fail(download, answer);
		return;
	}
	take_losses(download, &answer->body);
	if (answer->body.failed)
		set_state(download, DOWNLOAD_FAILED, _("The board answers nonsense"));
	else
		set_state(download, DOWNLOAD_ASKS, NULL);
}

static void sent(gpointer data, struct board_answer *answer)
{
	const struct sending *sending = data;
	LadderBoardDownload *download = sending->download;
	struct wire_writer fields;

	if (download->state != DOWNLOAD_SENDS)
		return; /* cancelled */
	if (answer->end != DESK_GOOD) {
		fail(download, answer);
		return;
	}
	fields = ladder_board_link_begin(download->link);
	ladder_board_link_send(download->link, SERVICE_VERIFY, &fields, download, verified,
			       download);
}

static gboolean look(gpointer data)
{
	g_signal_emit(data, changed_signal, 0);
	return G_SOURCE_CONTINUE;
}

LadderBoardDownload *ladder_board_download_new(LadderBoardLink *link,
					       struct board_program *program)
{
	LadderBoardDownload *download = g_object_new(LADDER_TYPE_BOARD_DOWNLOAD, NULL);
	const struct board_status *status = ladder_board_link_status(link);

	download->link = g_object_ref(link);
	download->sending->program = board_program_ref(program);
	download->expect.mode = EXPECT_ANY;
	if (status)
		memcpy(download->expect.program, status->program, sizeof(status->program));
	download->timer = g_timeout_add(LOOK_MS, look, download);
	begin(download);
	return download;
}

/* ---- its end ---- */

static void committed(gpointer data, struct board_answer *answer)
{
	LadderBoardDownload *download = data;

	if (answer->end == DESK_GOOD)
		set_state(download, DOWNLOAD_DONE, NULL);
	else if (answer->end == DESK_GONE || answer->end == DESK_LATE)
		set_state(download, DOWNLOAD_FAILED,
			  _("The connection ended before the board had answered: it runs the old "
			    "program or the new one, whole. Connect again to see which."));
	else
		fail(download, answer);
}

void ladder_board_download_commit(LadderBoardDownload *download, bool restart)
{
	struct wire_writer fields = ladder_board_link_begin(download->link);

	if (download->state != DOWNLOAD_ASKS)
		return;
	wire_put_expect(&fields, &download->expect);
	wire_put_u8(&fields, restart);
	set_state(download, DOWNLOAD_COMMITS, NULL);
	ladder_board_link_send(download->link, SERVICE_COMMIT, &fields, download, committed,
			       download);
}

void ladder_board_download_cancel(LadderBoardDownload *download)
{
	struct wire_writer fields = ladder_board_link_begin(download->link);

	if (download->state != DOWNLOAD_SENDS && download->state != DOWNLOAD_ASKS)
		return;
	g_atomic_int_set(&download->sending->stop, 1);
	if (ladder_board_link_state(download->link) == LINK_CONNECTED)
		ladder_board_link_send(download->link, SERVICE_ABORT, &fields, NULL, NULL, NULL);
	set_state(download, DOWNLOAD_FAILED, "");
}

enum download_state ladder_board_download_state(LadderBoardDownload *download)
{
	return download->state;
}

double ladder_board_download_part(LadderBoardDownload *download)
{
	const uint32_t size = stored_size(&download->sending->program->stored);

	return size ? g_atomic_int_get(&download->sending->done) / (double)size : 0;
}

const char *ladder_board_download_why(LadderBoardDownload *download)
{
	return download->why ? download->why : "";
}

bool ladder_board_download_needs_restart(LadderBoardDownload *download)
{
	return download->needs_restart;
}

GPtrArray *ladder_board_download_losses(LadderBoardDownload *download)
{
	return download->losses;
}

guint ladder_board_download_more(LadderBoardDownload *download)
{
	return download->more;
}

/* ---- life ---- */

static void ladder_board_download_dispose(GObject *object)
{
	LadderBoardDownload *download = LADDER_BOARD_DOWNLOAD(object);

	g_clear_handle_id(&download->timer, g_source_remove);
	if (download->sending)
		g_atomic_int_set(&download->sending->stop, 1);
	g_clear_pointer(&download->sending, sending_unref);
	g_clear_object(&download->link);
	g_clear_pointer(&download->losses, g_ptr_array_unref);
	g_clear_pointer(&download->why, g_free);
	G_OBJECT_CLASS(ladder_board_download_parent_class)->dispose(object);
}

static void ladder_board_download_class_init(LadderBoardDownloadClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_board_download_dispose;
	changed_signal = g_signal_new("changed", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0,
				      NULL, NULL, NULL, G_TYPE_NONE, 0);
}

static void ladder_board_download_init(LadderBoardDownload *download)
{
	download->sending = g_new0(struct sending, 1);
	download->sending->download = download;
	g_atomic_ref_count_init(&download->sending->count);
	download->losses = g_ptr_array_new_with_free_func(g_free);
}
