#!/usr/bin/env perl
# SPDX-License-Identifier: MIT
# architecture.t - every file, folder, function and make target that ARCHITECTURE.md names
# exists.
#
# A file name is a path from the top, or below runtime/, runtime/engine/ or editor-gtk/, or
# the name of at least one file anywhere.
use strict;
use warnings;
use File::Find;
use FindBin;

chdir "$FindBin::Bin/.." or die;
my (%base, $sources);
find({ no_chdir => 1, wanted => sub {
	return if m{^\./(?:\.git|build)};
	(my $path = $_) =~ s{^\./}{};
	push @{ $base{$1} }, $path if m{([^/]+)\z};
	if (-f && /\.(?:c|h)\z/ && !m{^\./tests/}) {
		open my $in, '<', $_ or die "$_: $!";
		local $/;
		$sources .= <$in>;
	}
} }, '.');
open my $make, '<', 'Makefile' or die;
my $makefile = do { local $/; <$make> };
open my $page, '<', 'ARCHITECTURE.md' or die;
my $text = do { local $/; <$page> };
$text =~ s/^```.*?^```//gms;

my ($n, $failed, %seen) = (0, 0);
sub check {
	my ($good, $name) = @_;

	printf "%sok %d - %s\n", $good ? "" : "not ", ++$n, $name;
	$failed ||= !$good;
}
sub found {
	my ($path) = @_;

	for my $top ('', 'runtime/', 'runtime/engine/', 'editor-gtk/', 'tests/') {
		my ($hit) = glob("$top$path");
		return 1 if defined $hit && -e $hit;
	}
	(my $leaf = $path) =~ s{.*/}{};
	return $path !~ m{/} && $base{$leaf};
}
while ($text =~ /`([^`\n]+)`/g) {
	my $said = $1;

	for my $name (split / /, $said) {
		next if $seen{$name}++ || $name =~ /NAME|LANG|\bX\b|_X/;
		if ($name =~ /^(\w+)\(\)$/) {
			my $function = $1;
			check(scalar($sources =~ /\b\Q$function\E\(/), "function $name");
		} elsif ($name =~ m{^[\w.*/-]+(?:\.(?:c|h|def|sh|t|pl|py|md|ui)|/)$}) {
			check(found($name), "file $name");
		}
	}
	if ($said =~ /^make ([a-z-]+)$/ && !$seen{$said}++) {
		my $target = $1;
		check(scalar($makefile =~ /^\Q$target\E:/m), $said);
	}
	check(scalar($sources =~ /\b\Q$said\E\b/), $said)
		if $said =~ /^(?:struct|enum) \w+$/ && !$seen{$said}++;
}
check($n > 100, "it found the names ($n of them)");
print "1..$n\n";
exit $failed;
