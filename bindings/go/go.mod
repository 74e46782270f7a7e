module example.com/kiri

go 1.24
