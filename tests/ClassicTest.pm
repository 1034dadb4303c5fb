# SPDX-License-Identifier: MIT
#
# ClassicTest - for the tests of ClassicLadder projects: runs programs, finds projects, and
# strictly reads an exported project.
#
# strict() checks the rules by which ClassicLadder loads a project, including inputs on
# which it crashes. It returns the errors, line by line.
package ClassicTest;
use strict;
use warnings;
use Exporter 'import';
use Files;
our @EXPORT = qw(run said slurp spew project_of members strict);

# The standard output of a command, and its status if it failed.
sub run {
	my (@command) = @_;
	open my $out, '-|', 'sh', '-c', 'exec "$@" 2>/dev/null', 'sh', @command
		or return "cannot run $command[0]\n";
	binmode $out;
	local $/;
	my $text = <$out>;
	close $out;
	$text = '' unless defined $text;
	$text .= "exit status " . ($? >> 8) . "\n" if $?;
	return $text;
}

# The output of a command, both streams, and its exit status; from 128 on: ended by a
# signal.
sub said {
	my (@command) = @_;
	open my $out, '-|', 'sh', '-c', 'exec "$@" 2>&1 </dev/null', 'sh', @command or die;
	binmode $out;
	local $/;
	my $text = <$out>;
	close $out;
	return (defined $text ? $text : '', $? & 127 ? 128 + ($? & 127) : $? >> 8);
}

sub project_of {
	my ($base) = @_;
	for my $end ('.clp', '.clprj', '.clprjz', '.txt', '') {
		return "$base$end" if -e "$base$end";
	}
	return undef;
}

# ---- the rules of ClassicLadder ----

my @upstream = qw(project_infos.txt general.txt timers.csv monostables.csv counters.csv
	timers_iec.csv registers.csv arithmetic_expressions.csv rung sections.csv sequential.csv
	symbols.csv ioconf.csv com_params.txt modbusioconf.csv config_events.csv modem_config.txt
	remote_alarms.txt spy_vars.csv);
my %only_upstream = map { $_ => 1 } qw(project_infos.txt registers.csv config_events.csv
	modem_config.txt remote_alarms.txt spy_vars.csv);
# The type of a variable: the setting with their number; the types that may be written.
my %sizes = (0 => 'BITS', 10 => 'TIMERS', 11 => 'TIMERS', 15 => 'TIMERS_IEC', 20 => 'MONOSTABLES',
	25 => 'COUNTERS', 26 => 'COUNTERS', 27 => 'COUNTERS', 50 => 'PHYS_INPUTS',
	60 => 'PHYS_OUTPUTS', 80 => 'REGISTERS', 81 => 'REGISTERS', 200 => 'WORDS',
	230 => 'TIMERS', 231 => 'TIMERS', 240 => 'MONOSTABLES', 241 => 'MONOSTABLES',
	250 => 'COUNTERS', 251 => 'COUNTERS', 260 => 'TIMERS_IEC', 261 => 'TIMERS_IEC',
	270 => 'PHYS_WORDS_INPUTS', 280 => 'PHYS_WORDS_OUTPUTS', 301 => 'REGISTERS',
	302 => 'REGISTERS');
my %count = (30 => 128, 65 => 100, 70 => 100, 75 => 100, 220 => 128, 290 => 20, 300 => 100,
	310 => 100);
my %writable = map { $_ => 1 } 0, 200, 60, 280, 65, 260, 230, 240, 250, 251, 300, 310, 75;
my %block = (10 => [2, 2, 'TIMERS'], 11 => [2, 2, 'MONOSTABLES'], 12 => [2, 4, 'COUNTERS'],
	13 => [2, 2, 'TIMERS_IEC'], 14 => [2, 3, 'REGISTERS'], 20 => [3, 1, undef],
	60 => [3, 1, undef]);

my (%p, @faults); # the current project

sub fault { push @faults, join('', @_); return }

# The members of a project: name => text, and their order.
sub members {
	my ($text) = @_;
	my (%text, @order);
	while ($text =~ m{^_FILE-(\S+)\n(.*?)^_/FILE-\1\n}msg) {
		push @order, $1;
		$text{$1} = $2;
	}
	return (\%text, \@order);
}

sub lines { return split /\n/, $p{text}{ $_[0] } // '' }

sub check_variable {
	my ($where, $type, $number, $index) = @_;
	my $most = exists $sizes{$type} ? $p{set}{"SIZE_NBR_$sizes{$type}"} // 0 : $count{$type};
	return fault("$where: variable of type $type") unless defined $most;
	fault("$where: type $type is not of this dialect")
		if $p{lc} ? $type =~ /^(65|80|81|301|302)$/ : $type =~ /^(75|310)$/;
	fault("$where: $type/$number of $most") if $number >= $most;
	return unless defined $index;
	return fault("$where: index $index") unless $index =~ m{^(\d+)/(\d+)$} && $1 >= 200;
	check_variable("$where index", $1, $2, undef);
}

# ---- expressions: by precedence, left to right ----

my $var = qr{@(\d+)/(\d+)(?:\[(\d+/\d+)\])?@};

sub take { my ($at, $what) = @_; return $$at =~ s/^(?:$what)// }

sub term {
	my ($at, $where) = @_;
	take($at, '!');
	if ($$at =~ s/^$var//) {
		check_variable($where, $1, $2, $3);
	} elsif ($$at =~ s/^([A-Z]+)\(//) {
		my ($name, $some) = ($1, $p{lc} ? qr{$var} : qr{$var|\d+});
		fault("$where: function $name") unless $name =~ /^(ABS|MINI|MAXI|AVG|MOY)$/ ||
			(!$p{lc} && $name =~ /^(POW|SHL|SHR|ROL|ROR)$/);
		fault("$where: argument $$at") unless $$at =~ s/^$some(,$some)*\)//;
	} elsif (take($at, '\(')) {
		level($at, $where, 0);
		fault("$where: no ) at $$at") unless take($at, '\)');
	} elsif (!take($at, '-?\d+')) {
		fault("$where: what is $$at");
		$$at = '';
	}
}

sub level {
	my ($at, $where, $rank) = @_;
	my @op = ('\|', '\^', '&', '[-+]', '[*/%]');
	return term($at, $where) if $rank > $#op;
	level($at, $where, $rank + 1);
	while ($$at ne '' && take($at, $op[$rank])) {
		fault("$where: ^ is no xor there") if $p{lc} && $rank == 1 && !$p{power};
		fault("$where: a sign behind an operator") if $$at =~ /^-/;
		level($at, $where, $rank + 1);
	}
}

sub check_expression {
	my ($where, $number, $operate) = @_;
	my $text = $p{expression}{$number};
	return fault("$where: no expression $number") unless defined $text;
	my $rest = $text;
	if ($operate) {
		return fault("$where: no assignment: $text") unless $rest =~ s/^$var:=//;
		fault("$where: writes to $1/$2") unless $writable{$1};
		check_variable($where, $1, $2, $3);
		level(\$rest, $where, 0);
	} else {
		level(\$rest, $where, 0);
		fault("$where: no comparison: $text") unless take(\$rest, '<>|<=|>=|=|<|>');
		level(\$rest, $where, 0);
	}
	fault("$where: left over in $text: $rest") if $rest ne '';
}

sub read_expressions {
	for (lines('arithmetic_expressions.csv')) {
		next if /^#VER=2\.0$/;
		fault("expression: $_"), next unless /^(\d{4}),(\S+)$/;
		fault("expression $1 twice") if exists $p{expression}{ $1 + 0 };
		fault("expression of ", length $2, " bytes") if length $2 > 49;
		$p{expression}{ $1 + 0 } = $2;
	}
	fault('more expressions than SIZE_NBR_ARITHM_EXPR')
		if keys %{ $p{expression} } > ($p{set}{SIZE_NBR_ARITHM_EXPR} // 0);
}

# ---- rungs ----

sub check_cell {
	my ($where, $cell, $last) = @_;
	my ($code, $top, $type, $number, $index) = @$cell;
	my $at_end = $code >= 50 && $code <= 60;
	fault("$where: element $code") unless $code =~ /^([0-4]|9|1[0-4]|20|5[0-5]|60|99)$/;
	fault("$where: registers are upstream's") if $p{lc} && $code == 14;
	fault("$where: $code in the ", ($last ? 'last column' : 'middle'))
		if $code && $code != 99 && $at_end != $last;
	if ($code >= 1 && $code <= 4 || $code >= 50 && $code <= 53) {
		check_variable($where, $type, $number, $index);
		fault("$where: writes to $type/$number") if $at_end && !$writable{$type} && !($type == 30 && $p{steps});
	} elsif ($code == 54) {
		push @{ $p{jump} }, [$where, $number];
	} elsif ($code == 55) {
		push @{ $p{call} }, [$where, $number];
	} elsif ($code == 20 || $code == 60) {
		check_expression($where, $number, $code == 60);
	} elsif ($block{$code} && $number >= ($p{set}{"SIZE_NBR_$block{$code}[2]"} // 0)) {
		fault("$where: block $number");
	}
}

sub check_blocks {
	my ($where, $grid) = @_;
	my %part;
	for my $y (0 .. $#$grid) {
		for my $x (0 .. $#{ $grid->[$y] }) {
			my $size = $block{ $grid->[$y][$x][0] } or next;
			for my $dy (0 .. $size->[1] - 1) {
				for my $dx (0 .. $size->[0] - 1) {
					next unless $dx || $dy;
					my $there = $x - $dx < 0 ? undef : $grid->[$y + $dy][$x - $dx];
					fault("$where: block at $y,$x has a hole")
						unless $there && $there->[0] == 99;
					fault("$where: two blocks in one place")
						if $part{ $y + $dy, $x - $dx }++;
				}
			}
		}
	}
	for my $y (0 .. $#$grid) {
		for my $x (0 .. $#{ $grid->[$y] }) {
			fault("$where: 99 at $y,$x of no block")
				if $grid->[$y][$x][0] == 99 && !$part{ $y, $x };
		}
	}
}

sub check_rung {
	my ($name) = @_;
	my ($number) = $name =~ /^rung_(\d+)\.csv$/ or return fault("member $name");
	my ($rows, $columns) = $p{lc} ? (6, 10) : (8, 12);
	my ($version, @line) = lines($name);
	my (%head, @grid);
	fault("$name: $version") if $version ne ($p{lc} ? '#VER=2.0' : '#VER=3.0');
	for (@line) {
		if (/^#(\w+)=(.*)$/) { $head{$1} = $2; next }
		my @cell = map { [m{^(\d+)-([01])-(\d+)/(\d+)(?:\[(\d+/\d+)\])?$}] } split / , /;
		return fault("$name: row $_") if grep { !@$_ } @cell;
		fault("$name: ", scalar @cell, " columns") if @cell != $columns;
		push @grid, \@cell;
	}
	fault("$name: ", scalar @grid, " rows") if @grid != $rows;
	my %most = (LABEL => 9, COMMENT => 29, COMMENT_LONG => $p{lc} ? 0 : 99);
	for (keys %most) {
		fault("$name: $_ too long") if length($head{$_} // '') > $most{$_};
	}
	$p{rung}{$number} = [$head{PREVRUNG} // 'none', $head{NEXTRUNG} // 'none'];
	fault("$name: rung beyond SIZE_NBR_RUNGS") if $number >= ($p{set}{SIZE_NBR_RUNGS} // 0);
	for my $y (0 .. $#grid) {
		check_cell("$name $y,$_", $grid[$y][$_], $_ == $columns - 1) for 0 .. $#{ $grid[$y] };
	}
	fault("$name: joined with what is above row 0") if grep { $_->[1] } @{ $grid[0] };
	check_blocks($name, \@grid);
}

# ---- sections, blocks, the rest ----

sub check_sections {
	my (%name, %routine, %of);
	for (lines('sections.csv')) {
		next if /^#VER=1\.0$/;
		if (/^#NAME(\d{3})=(.*)$/) {
			fault("section name $2") if length $2 > 19 || $2 eq '';
			$name{ $1 + 0 } = 1;
			next;
		}
		fault("section $_"), next unless /^(\d{3}),([01]),(-1|\d+),(-?\d+),(-?\d+),(\d+)$/;
		my ($number, $sfc, $routine, $first, $last, $page) = ($1 + 0, $2, $3, $4, $5, $6);
		fault("section $number has no name") unless $name{$number};
		$routine{$routine} = 1;
		fault("page $page") if $page > 4;
		next if $sfc;
		my ($at, $before, $steps) = ($first, -1, 0);
		while (defined $p{rung}{$at} && $steps++ < 2000) {
			$of{$at} = $number;
			fault("rung $at: PREVRUNG") if $p{rung}{$at}[0] ne $before;
			last if $at == $last;
			($before, $at) = ($at, $p{rung}{$at}[1]);
		}
		fault("section $number: its rungs end at $at, not $last") if $at != $last;
		fault("rung $at: NEXTRUNG") if ($p{rung}{$at}[1] // '') ne '-1';
	}
	fault('more sections than SIZE_NBR_SECTIONS')
		if keys %name > ($p{set}{SIZE_NBR_SECTIONS} // 0);
	for (keys %{ $p{rung} }) { fault("rung $_ is in no section") unless defined $of{$_} }
	for (@{ $p{call} }) { fault("$_->[0]: calls $_->[1]") unless $routine{ $_->[1] } }
	for (@{ $p{jump} }) {
		my ($from) = $_->[0] =~ /rung_(\d+)/;
		fault("$_->[0]: jumps to $_->[1]")
			unless defined $of{ $_->[1] } && $of{ $_->[1] } == $of{$from};
	}
}

sub check_block_lines {
	my %form = ('timers.csv' => ['T', 2, 'TIMERS'], 'monostables.csv' => ['M', 2, 'MONOSTABLES'],
		'counters.csv' => ['C', 1, 'COUNTERS'], 'timers_iec.csv' => ['TM', 3, 'TIMERS_IEC'],
		'registers.csv' => ['R', 1, 'REGISTERS']);
	for my $name (sort keys %form) {
		my ($letter, $values, $key) = @{ $form{$name} };
		my $next = 0;
		for (lines($name)) {
			next if !$p{lc} && /^#VER=/;
			my ($number, @value) = split /,/;
			if ($p{lc}) {
				unshift @value, $number;
				$number = $next++;
			} elsif ($number !~ s/^$letter(?=\d+$)//) {
				fault("$name: $_");
				next;
			}
			fault("$name: $_") if @value != $values || grep { !/^\d+$/ || $_ > 9999 } @value;
			fault("$name: base $value[0]") if $values > 1 && $value[0] > 2;
			fault("$name: mode $value[2]") if $values > 2 && $value[2] > 2;
			fault("$name: number $number") if $number >= ($p{set}{"SIZE_NBR_$key"} // 0);
		}
	}
}

sub check_symbols {
	my %seen;
	for (lines('symbols.csv')) {
		next if /^#VER=1\.0$/;
		my @field = split /,/, $_, -1;
		fault("symbol $_"), next if @field != 3 || $field[0] !~ /^%[A-Z]+\d+$/;
		fault("symbol $_: too long") if length $field[0] > 9 || length $field[1] > 9 ||
			length $field[2] > ($p{lc} ? 49 : 29);
		fault("symbol $field[1] twice") if $field[1] ne '' && $seen{ $field[1] }++;
	}
}

sub check_pages {
	my (%step, %transition, %condition);
	my $most = $p{lc} ? 16 : 32;
	for (lines('sequential.csv')) {
		next if /^#VER=1\.0$/;
		my ($what, @value) = split /,/, $_, -1;
		if ($what =~ /^S(\d+)$/ && $1 < 128 && @value == 5) {
			$step{$1} = 1;
			fault("step $_") if $value[1] >= 128 || $value[2] > 4 || $value[3] >= $most ||
				$value[4] >= $most;
		} elsif ($what =~ /^T(\d+)$/ && $1 < 256 && @value == 43) {
			$transition{$1} = 1;
			for my $list (0, 10, 20, 30) {
				my @of = @value[$list .. $list + 9];
				fault("transition $1 is not packed") if "@of" =~ /-1 \d/;
				fault("transition $1 names no step")
					if $list < 20 && grep { $_ >= 0 && !$step{$_} } @of;
			}
		} elsif ($what =~ /^C(\d+)$/ && @value == 2 && $value[1] =~ m{^(\d+)/(\d+)$}) {
			check_variable("condition $what", $1, $2, undef);
			$condition{$what =~ s/C//r} = 1;
		} elsif ($what !~ /^N([0-4]?\d)$/ || @value != 4 || length $value[3] > 50) {
			fault("page: $_") unless $what =~ /^P[0-4]$/ && !$p{lc};
		}
	}
	for (keys %transition) { fault("transition $_ has no condition") unless $condition{$_} }
}

sub check_io {
	for (lines('ioconf.csv')) {
		next if /^#VER=1\.0$/;
		my @value = split /,/;
		fault("I/O $_") if @value != ($p{lc} ? 6 : 8) || grep { !/^-?\d+$/ } @value;
	}
}

# The errors of an exported project; (): ClassicLadder accepts it. lc: for LinuxCNC; power:
# ^ is a power, as in LinuxCNC; steps: the project writes bits of steps, which the editor of
# ClassicLadder does not allow.
sub strict {
	my ($text, %option) = @_;
	my $lc = $option{lc};
	%p = %option;
	@faults = ();
	my ($members, $order) = members($text);
	my @want = grep { !$lc || !$only_upstream{$_} } @upstream;
	my @kinds;
	for (map { /^rung_/ ? 'rung' : $_ } @$order) {
		push @kinds, $_ unless @kinds && $_ eq 'rung' && $kinds[-1] eq 'rung';
	}
	$p{text} = $members;
	fault('does not begin or end as it must')
		if $text !~ m{\A_FILES_CLASSICLADDER\n} || $text !~ m{^_/FILES_CLASSICLADDER\n\z}m;
	fault('a line of more than 298 bytes') if grep { length > 298 } split /\n/, $text;
	fault("$_ is empty") for grep { $members->{$_} !~ /\S/ } @$order;
	fault('too many members') if @$order > 2000;
	fault("members: @kinds") if "@kinds" ne "@want" &&
		"@kinds" ne join ' ', grep { $_ ne 'rung' } @want;
	for (lines('general.txt')) {
		/^(\w+)=(.*)$/ ? $p{set}{$1} = $2 : fault("general.txt: $_");
	}
	read_expressions();
	check_rung($_) for grep { /^rung_/ } @$order;
	check_sections();
	check_block_lines();
	check_symbols();
	check_pages();
	check_io();
	return @faults;
}

1;
