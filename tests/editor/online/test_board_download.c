/* SPDX-License-Identifier: MIT
 *
 * test_board_download - a download to a real ladderd: what it would lose is told before anything changes, one that
 * is cancelled changes nothing, and the next one replaces the program.
 */
#include "editor-gtk/online/board_download.h"
#include "tests/editor/online/board.h"

#include "engine/scan/resource.h"

#include <string.h>

#define OTHER "RUNGBOARD 1\nPROJECT \"Seal\"\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Motor AT %QX0.0 : BOOL;\nEND_VAR\n\n" \
	"PROGRAM Main LD\nRUNG\n  | NC Start | COIL Motor |\nEND_PROGRAM\n"

static LadderBoardLink *link_to;

static const struct board_status *status(void)
{
	return ladder_board_link_status(link_to);
}

static bool runs(const uint8_t *program)
{
	return status() && status()->mode == STATE_RUN && memcmp(status()->program, program, sizeof(status()->program)) == 0;
}

/* With a text that takes many blocks. */
static struct board_program *make_program(const struct test_board *board)
{
	GString *text = g_string_new(OTHER);
	LadderDocument *document = ladder_document_new();
	char *path = board_path(board, "other.rung");
	struct board_program *program;

	g_string_append(text, "\nPROGRAM Long IL\n");
	for (int i = 0; i < 4000; i++)
		g_string_append_printf(text, "  LD %%MW%d (* step %d of a long program, to be sent in many blocks *)\n  ST %%MW%d\n",
				       2 * i % 4000, i, (7 * i + 5) % 2000 * 2);
	g_string_append(text, "END_PROGRAM\n");
	ladder_document_open_text(document, path, text->str, text->len, true);
	g_string_free(text, TRUE);
	program = board_program_new(document, BOARD_MAP, NULL);
	g_object_unref(document);
	g_free(path);
	return program;
}

static bool loses(LadderBoardDownload *download, const char *name)
{
	GPtrArray *losses = ladder_board_download_losses(download);

	for (guint i = 0; i < losses->len; i++)
		if (strstr(losses->pdata[i], name))
			return true;
	return false;
}

int main(void)
{
	struct test_board board = { .empty = false };
	struct board_program *program;
	LadderBoardDownload *download;
	uint8_t before[32];
	char *why = NULL;

	board_open(&board, "eng");
	link_to = ladder_board_link_new();
	CHECK(ladder_board_link_connect(link_to, board.where, &why));
	CHECK_SOON(status() && status()->mode == STATE_RUN);
	memcpy(before, status()->program, sizeof(before));
	program = make_program(&board);
	CHECK(program != NULL);

	download = ladder_board_download_new(link_to, program);
	CHECK_SOON(ladder_board_download_state(download) == DOWNLOAD_ASKS);
	CHECK_AS(loses(download, "Count") && !loses(download, "Motor"), "the value that is lost is named");
	CHECK(!ladder_board_download_needs_restart(download) && ladder_board_download_part(download) == 1);
	CHECK_AS(runs(before), "nothing has changed yet");
	ladder_board_download_cancel(download);
	CHECK(ladder_board_download_state(download) == DOWNLOAD_FAILED);
	ladder_board_download_commit(download, false);
	CHECK_AS(ladder_board_download_state(download) == DOWNLOAD_FAILED, "what was cancelled is not committed");
	g_object_unref(download);

	download = ladder_board_download_new(link_to, program);
	ladder_board_download_cancel(download);
	CHECK_AS(ladder_board_download_state(download) == DOWNLOAD_FAILED, "cancelled while it is sent");
	g_object_unref(download);
	g_object_unref(ladder_board_download_new(link_to, program)); /* forgotten while it is sent */

	download = ladder_board_download_new(link_to, program);
	CHECK_SOON(ladder_board_download_state(download) == DOWNLOAD_ASKS);
	CHECK_AS(runs(before), "the board runs what it ran");
	ladder_board_download_commit(download, false);
	CHECK_SOON(ladder_board_download_state(download) == DOWNLOAD_DONE);
	CHECK_SOON(status() && status()->mode == STATE_RUN && !runs(before));
	g_object_unref(download);
	board_program_unref(program);
	g_object_unref(link_to);
	board_close(&board);
	return tap_done();
}
