#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# docs.t - the examples of the documents work. Each ```rung block is a whole file without an
# error, canonical, and runs. Each command of a ```console block is run and must print the shown
# output. Files and headings that links name exist. tests/facts.t tests facts in the prose.
#
# A second word on a fence (```rung lamp.rung, ```text steps) is a file name: the block is
# written to this file for later commands. Each document has its own folder with a copy of
# ladders/. In shown output, `…` means any text in a line, and alone in a line any lines.
use strict;
use warnings;
use utf8;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Path qw(make_path);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

binmode $_, ':encoding(UTF-8)'
	for *STDOUT, Test::More->builder->output, Test::More->builder->failure_output;

my $utf8 = ':encoding(UTF-8)';
my $top = abs_path(dirname(__FILE__) . '/..');
my $build = abs_path($ENV{BUILD} // "$top/build");
$ENV{PATH} = "$build:$ENV{PATH}";
$ENV{LC_ALL} = 'C.UTF-8';
delete @ENV{qw(COLUMNS NO_COLOR CLICOLOR_FORCE)};

sub run_in {
	my ($folder, $command) = @_;
	spew("$folder/.command", $command, $utf8);
	my $pid = open my $from, '-|:encoding(UTF-8)', 'sh', '-c',
		'cd "$1" && exec 2>&1 </dev/null && . ./.command', 'sh', $folder;
	die "sh: $!" if !$pid;
	local $/;
	my $text = <$from> // '';
	close $from;
	return ($text, $? >> 8, $? & 127);
}

# The blocks of a document: text of the fence, line, content.
sub blocks_of {
	my ($path) = @_;
	my (@blocks, $open);
	my $line = 0;
	for (split /\n/, slurp($path, $utf8), -1) {
		$line++;
		if (!$open && /^```(\S*)\s*(\S*)/) {
			$open = { kind => $1, name => $2, line => $line, text => '' };
		} elsif ($open && /^```\s*$/) {
			push @blocks, $open;
			undef $open;
		} elsif ($open) {
			$open->{text} .= "$_\n";
		}
	}
	ok(!$open, basename($path) . ': every fence is closed');
	return @blocks;
}

sub check_rung {
	my ($folder, $file, $where) = @_;
	spew("$folder/.one", ".\n", $utf8);
	for my $command ("ladder check $file", "ladder fmt --check $file",
			 "ladder trace $file .one") {
		my ($text, $status, $signal) = run_in($folder, $command);
		ok($status == 0 && $signal == 0, "$where: $command")
			or diag("status $status, signal $signal\n$text");
	}
}

# A regular expression for the shown text.
sub pattern_of {
	my ($shown) = @_;
	my $pattern = '';
	for (split /(?<=\n)/, $shown) {
		if (/^\s*…\s*$/) {
			$pattern .= '(?:.*\n)*?';
			next;
		}
		s/\s+\n\z/\n/;
		$pattern .= join '[^\n]*', map { quotemeta } split /…/, $_, -1;
	}
	return qr/\A$pattern\z/;
}

sub check_console {
	my ($folder, $block, $where) = @_;
	my @steps;
	my $line = $block->{line};
	for (split /(?<=\n)/, $block->{text}) {
		$line++;
		if (/^\$ (.*)\n/) {
			push @steps, { command => $1, shown => '', line => $line };
		} elsif (@steps) {
			$steps[-1]{shown} .= $_;
		} else {
			fail("$where: a console block begins with \$");
		}
	}
	ok(@steps > 0, "$where: has commands");
	for my $step (@steps) {
		# There is no editor without GTK, and no ladder-modbus without libmodbus. The commands behind it
		# read what it draws or serves.
		if ($step->{command} =~ /\b(ladder-editor|ladder-modbus|mbpoll)\b/ && system("command -v $1 >/dev/null") != 0) {
			SKIP: { skip("$where:$step->{line}: there is no $1", 1) }
			last;
		}
		my ($text, undef, $signal) = run_in($folder, $step->{command});
		$text =~ s/[ \t]+$//mg;
		ok($signal == 0 && $text =~ pattern_of($step->{shown}),
		   "$where:$step->{line}: $step->{command}")
			or diag("signal $signal, answers\n$text");
	}
}

# The places of a document that a link can name: `# Elements of arrays` is elements-of-arrays.
sub places_of {
	my $text = slurp($_[0], $utf8) =~ s/^```.*?^```//gmsr;
	my (%place, %seen);
	for ($text =~ /^#+ (.*)$/mg) {
		my $place = lc s/\[([^\]]*)\]\([^)]*\)/$1/gr;
		$place =~ s/[^\w\s-]//g;
		$place =~ tr/ /-/;
		my $before = $seen{$place}++;
		$place{$before ? "$place-$before" : $place} = 1;
	}
	return \%place;
}

sub check_links {
	my ($path) = @_;
	my $text = slurp($path, $utf8) =~ s/^```.*?^```//gmsr;
	while ($text =~ /\]\(([^)#\s]*)(?:#([^)\s]*))?[^)]*\)/g) {
		my ($link, $place) = ($1, $2);
		next if $link =~ /^\w+:/;
		my $file = $link eq '' ? $path : dirname($path) . "/$link";
		ok(-e $file, basename($path) . " links to $link") if $link ne '';
		ok(places_of($file)->{$place}, basename($path) . " links to $link#$place")
			if defined $place && -e $file;
	}
}

my %count = (rung => 0, console => 0);
check_links($_) for glob("$top/docs/*.md"), glob("$top/*.md");
for my $path (glob("$top/docs/*.md"), "$top/README.md") {
	my $folder = tempdir(CLEANUP => 1);
	my $doc = basename($path);
	my $number = 0;

	system('cp', '-R', "$top/ladders", "$folder/ladders") == 0
		or die 'cannot copy ladders/';
	for my $block (blocks_of($path)) {
		my $kind = $block->{kind};
		my $name = $block->{name};

		$name = sprintf 'block%d.rung', ++$number
			if $kind eq 'rung' && $name eq '';
		make_path(dirname("$folder/$name")) if $name =~ m{/};
		spew("$folder/$name", $block->{text}, $utf8) if $name ne '';
		$count{$kind}++ if exists $count{$kind};
		check_rung($folder, $name, "$doc:$block->{line}")
			if $kind eq 'rung';
		check_console($folder, $block, $doc) if $kind eq 'console';
	}
}
# At least some blocks must be found.
cmp_ok($count{rung}, '>=', 20, 'examples were found');
cmp_ok($count{console}, '>=', 10, 'commands were found');
done_testing();
