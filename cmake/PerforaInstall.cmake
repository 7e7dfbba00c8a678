# cmake --install and find_package(Perfora): rooms as Perfora::io ... Perfora::report, headers under include/perfora.
