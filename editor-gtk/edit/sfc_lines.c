/* SPDX-License-Identifier: MIT
 *
 * sfc_lines - lines of a file and parts of a chart; see sfc_lines.h.
 */
#include "editor-gtk/edit/sfc_lines.h"

static int lines_of(const char *comment)
{
	int lines = *comment != '\0';

	for (; *comment; comment++)
		lines += *comment == '\n';
	return lines;
}

static int below(const struct project *project, uint32_t comment, int line)
{
	return line - lines_of(project_text(project, comment));
}

int sfc_line_of(const struct project *project, const struct sfc *sfc, struct sfc_spot spot)
{
	const int i = spot.index;

	switch (spot.kind) {
	case SPOT_NONE:
		break;
	case SPOT_STEP:
		return below(project, sfc->step[i].comment, sfc->step[i].line);
	case SPOT_TRANSITION:
		return below(project, sfc->transition[i].comment, sfc->transition[i].line);
	case SPOT_USE:
		return below(project, sfc->use[i].comment, sfc->use[i].line);
	case SPOT_ACTION:
		return below(project, sfc->action[i].comment, sfc->action[i].line);
	case SPOT_CONTROL:
		return below(project, sfc->control_comment, sfc->control_line);
	}
	return 0;
}

static bool stands_behind_another(const struct sfc *sfc, struct sfc_spot spot)
{
	return spot.kind == SPOT_USE && spot.index > 0 &&
	       sfc->use[spot.index].line == sfc->use[spot.index - 1].line;
}

struct sfc_spot sfc_spot_at(const struct project *project, const struct sfc *sfc, int line)
{
	const int count[] = {
		[SPOT_STEP] = sfc->step_count, [SPOT_TRANSITION] = sfc->transition_count,
		[SPOT_USE] = sfc->use_count, [SPOT_ACTION] = sfc->action_count,
		[SPOT_CONTROL] = sfc->control_line > 0,
	};
	struct sfc_spot found = { SPOT_NONE, -1 }, spot;
	int best = 1;

	for (spot.kind = SPOT_STEP; spot.kind <= SPOT_CONTROL; spot.kind++)
		for (spot.index = 0; spot.index < count[spot.kind]; spot.index++) {
			const int begins = sfc_line_of(project, sfc, spot);

			if (begins < best || begins > line || stands_behind_another(sfc, spot))
				continue;
			best = begins;
			found = spot;
		}
	return found;
}
